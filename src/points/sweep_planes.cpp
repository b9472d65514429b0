// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_planes.h"

#include <algorithm>
#include <cmath>

namespace facet_mapping::detail {
namespace {

constexpr int kColumns = 12;  // of the grid of pixels that speak for the image
constexpr int kRows = 6;
constexpr int kDistances = 6;  // at which they are asked
/// So large a share of what moves in the image moves by no more than a step.
constexpr double kShare = 0.9;

/// Motion of the grid's pixels in all views, pixels per inverse distance.
std::vector<double> motions(const View& reference,
                            const std::vector<View>& others,
                            const Eigen::Vector3d& normal,
                            const InverseRange& distances,
                            const InverseRange& depths) {
  std::vector<double> rates;
  const PinholeCamera& camera = reference.camera;
  for (const View& other : others) {
    const RayMotion motion(reference, other);
    for (int n = 0; n < kColumns * kRows * kDistances; ++n) {
      const int row = n / kColumns % kRows;
      const int distance = n / (kColumns * kRows);
      const double x = (n % kColumns + 0.5) / kColumns * camera.width;
      const double y = (row + 0.5) / kRows * camera.height;
      const double place = (distance + 0.5) / kDistances;
      const Eigen::Vector3d ray = camera.ray({x, y});
      const double slope = normal.dot(ray);
      const double inverse = slope * (distances.low + place * (distances.high - distances.low));
      if (inverse >= depths.low && inverse <= depths.high) {
        const double rate = slope * pixel_rate(motion, other.camera, ray, inverse);
        if (rate > 0.0) {
          rates.push_back(rate);
        }
      }
    }
  }
  return rates;
}

}  // namespace

RayMotion::RayMotion(const View& from, const View& to) {
  const Eigen::Isometry3d to_from_from = to.cam_from_world() * from.world_from_cam;
  rotation = to_from_from.linear();
  shift = to_from_from.translation();
}

double pixel_rate(const RayMotion& motion,
                  const PinholeCamera& camera,
                  const Eigen::Vector3d& ray,
                  double inverse_depth) {
  const Eigen::Vector3d at = motion.at(ray, inverse_depth);
  if (!(at.z() > 0.05) || !camera.contains(camera.project(at))) {
    return 0.0;
  }
  return (camera.projection_jacobian(at) * motion.shift).norm();
}

SweepPlanes space_planes(const View& reference,
                         const std::vector<View>& others,
                         const Eigen::Vector3d& normal,
                         const InverseRange& distances,
                         const InverseRange& depths,
                         double step_px,
                         int max_planes) {
  SweepPlanes planes{normal, {}};
  std::vector<double> rates = motions(reference, others, normal, distances, depths);
  if (rates.empty()) {
    return planes;
  }
  const auto place =
      rates.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(rates.size() - 1));
  std::nth_element(rates.begin(), place, rates.end());
  const double length = distances.high - distances.low;
  const int steps = static_cast<int>(std::min(std::ceil(length * *place / step_px), 1e6));
  const int count = std::clamp(steps + 1, 4, max_planes);
  for (int k = 0; k < count; ++k) {
    planes.inverse_distances.push_back(distances.low + length * k / (count - 1));
  }
  return planes;
}

}  // namespace facet_mapping::detail
