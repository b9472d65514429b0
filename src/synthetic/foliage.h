// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The materials of leaves.
#pragma once

#include "random.h"

#include "facet_mapping/synthetic/material.h"

namespace facet_mapping {

Material foliage(const Eigen::Vector3f& color, std::uint32_t seed);

/// From green to olive.
Eigen::Vector3f leaf_color(Random* random);

}  // namespace facet_mapping
