// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the surface of a map ends to change.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace facet_mapping {

/// The surface outside this ball does not change any more.
struct FreezeLine {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the newest keyframe, map frame, metres
  double radius_m = std::numeric_limits<double>::infinity();

  /// False while nothing is frozen.
  bool is_limited() const { return std::isfinite(radius_m); }
  /// True if no point of the box is in the ball.
  bool is_outside(const Eigen::AlignedBox3d& box) const {
    return is_limited() && box.exteriorDistance(center) > radius_m;
  }
};

/// True if no point of the box is in the ball at any time while it moves straight from `a` to `b`
/// (with the larger of the two radii).
bool is_outside_between(const FreezeLine& a, const FreezeLine& b, const Eigen::AlignedBox3d& box);

}  // namespace facet_mapping
