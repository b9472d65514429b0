// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping {

struct ProjectionParts {
  Eigen::Matrix3d intrinsics;  ///< upper triangular, positive diagonal, last entry 1
  Eigen::Isometry3d cam_from_world;
};

/// K and [R | t] with K [R | t] = s P for some s of either sign (Hartley and Zisserman 2004,
/// section 6.2.4). Nothing if the left 3x3 part of P is singular.
std::optional<ProjectionParts> decompose_projection(const Eigen::Matrix<double, 3, 4>& projection);

}  // namespace facet_mapping
