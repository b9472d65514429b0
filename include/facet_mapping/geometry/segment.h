// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Distances to line segments.
#pragma once

#include <algorithm>

#include <Eigen/Core>

namespace facet_mapping {

/// From `point` to the nearest point of the segment a .. b, which may have no length.
inline double distance_to_segment(const Eigen::Vector3d& point,
                                  const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a;
  const double squared = ab.squaredNorm();
  const double along = squared > 0.0 ? std::clamp((point - a).dot(ab) / squared, 0.0, 1.0) : 0.0;
  return (a + along * ab - point).norm();
}

}  // namespace facet_mapping
