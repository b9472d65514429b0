// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The planes that a reference image is swept with.
#pragma once

#include <vector>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping::detail {

struct InverseRange {
  double low = 0.0;   // 1/m
  double high = 0.0;  // 1/m
};

/// Parallel planes normal . x = 1 / inverse_distance in the reference camera's frame.
struct SweepPlanes {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::vector<double> inverse_distances;  // 1/m, evenly spaced, rising
};

/// Where a point on a reference's ray (z = 1) is in another view: along + inverse_depth * shift, up
/// to scale.
struct RayMotion {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d shift;

  RayMotion(const View& from, const View& to);
  Eigen::Vector3d at(const Eigen::Vector3d& ray, double inverse_depth) const {
    return rotation * ray + inverse_depth * shift;
  }
};

/// d(pixel) / d(inverse depth) in the other view; 0 where that does not see the point.
double pixel_rate(const RayMotion& motion,
                  const PinholeCamera& camera,
                  const Eigen::Vector3d& ray,
                  double inverse_depth);

/// Planes over a range of inverse distances, so close that hardly a pixel moves by more than
/// `step_px` in any of the views from one to the next; at most `max_planes`.
SweepPlanes space_planes(const View& reference,
                         const std::vector<View>& others,
                         const Eigen::Vector3d& normal,
                         const InverseRange& distances,
                         const InverseRange& depths,
                         double step_px,
                         int max_planes);

}  // namespace facet_mapping::detail
