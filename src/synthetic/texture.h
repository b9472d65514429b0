// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Procedural textures: linear reflectance of a surface point, the same from every camera.
#pragma once

#include "facet_mapping/synthetic/material.h"

namespace facet_mapping {

/// `footprint`: metres of the surface that one sample stands for; finer detail is averaged.
Eigen::Vector3f reflectance(const Material& material,
                            const Eigen::Vector3f& point,
                            float footprint);

namespace texture {

Eigen::Vector3f asphalt(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f kerb(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f paving(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f grass(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f brick(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f plaster(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f panels(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f window(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f door(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f roof_tiles(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f car_body(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f wheel(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f sign(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f bark(const Material& m, const Eigen::Vector3f& p, float footprint);
Eigen::Vector3f foliage(const Material& m, const Eigen::Vector3f& p, float footprint);
/// Stone and metal: the material's colour with octaves of wear of the given strength.
Eigen::Vector3f worn(const Material& m, const Eigen::Vector3f& p, float footprint, float strength);

/// A colour made lighter or darker by `change`, never below a tenth.
Eigen::Vector3f shaded(const Eigen::Vector3f& color, float change);

}  // namespace texture
}  // namespace facet_mapping
