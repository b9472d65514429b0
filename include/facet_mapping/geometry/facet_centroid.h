// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

inline Eigen::Vector3d facet_centroid(const std::vector<Eigen::Vector3d>& points,
                                      const Triangle& facet) {
  return (points[facet[0]] + points[facet[1]] + points[facet[2]]) / 3.0;
}

}  // namespace facet_mapping
