// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Angles, normals and lengths that say how well a facet is shaped.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping {

struct FacetShape {
  Eigen::Vector3d normal;  ///< zero for a facet without area
  double sin_angle = 0.0;  ///< sine of its smallest angle, 0..0.87

  FacetShape(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    const double twice_area = cross.norm();
    const double ab = (b - a).norm();
    const double bc = (c - b).norm();
    const double ca = (a - c).norm();
    const double longer = std::max({ab * bc, bc * ca, ca * ab});  // the two sides at that angle
    const bool has_area = twice_area > 0.0 && longer > 0.0;
    normal = has_area ? Eigen::Vector3d(cross / twice_area) : Eigen::Vector3d::Zero();
    sin_angle = has_area ? twice_area / longer : 0.0;
  }
};

}  // namespace facet_mapping
