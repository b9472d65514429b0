// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_neighbours.h"

#include <algorithm>
#include <cmath>

namespace facet_mapping::detail {
namespace {

constexpr int kColumns = 7;  // of the grid of pixels that speak for the image
constexpr int kRows = 5;
constexpr double kLeastOverlap = 0.25;  // share of them that must be in the other image
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

bool is_neighbour(const View& reference,
                  const View& other,
                  double depth_m,
                  const SweepConfig& config) {
  if (!has_moved(reference, other, depth_m, config)) {
    return false;
  }
  const Eigen::Isometry3d other_from_world = other.cam_from_world();
  const double least_cosine = std::cos(config.max_parallax_deg * kRadiansPerDegree);
  int shared = 0;
  for (int n = 0; n < kColumns * kRows; ++n) {
    const int row = n / kColumns;
    const Eigen::Vector2d pixel((n % kColumns + 0.5) / kColumns * reference.camera.width,
                                (row + 0.5) / kRows * reference.camera.height);
    const Eigen::Vector3d point =
        reference.world_from_cam * (depth_m * reference.camera.ray(pixel));
    const Eigen::Vector3d in_other = other_from_world * point;
    const double cosine =
        (point - reference.center()).normalized().dot((point - other.center()).normalized());
    shared += in_other.z() > 0.0 && cosine >= least_cosine &&
                      other.camera.contains(other.camera.project(in_other))
                  ? 1
                  : 0;
  }
  return shared >= kLeastOverlap * kColumns * kRows;
}

}  // namespace

bool has_moved(const View& from, const View& to, double depth_m, const SweepConfig& config) {
  return (from.center() - to.center()).norm() >= config.min_motion * depth_m;
}

SweepNeighbours find_neighbours(const std::deque<SweepImage>& images,
                                std::size_t index,
                                double depth_m,
                                const SweepConfig& config) {
  SweepNeighbours found;
  const auto window = static_cast<std::size_t>(config.window);
  const std::size_t first = index - std::min(index, window);
  const std::size_t last = std::min(index + window, images.size() - 1);
  for (std::size_t k = first; k <= last; ++k) {
    if (k != index && is_neighbour(images[index].view, images[k].view, depth_m, config)) {
      (k < index ? found.before : found.after).push_back(&images[k]);
    }
  }
  return found;
}

}  // namespace facet_mapping::detail
