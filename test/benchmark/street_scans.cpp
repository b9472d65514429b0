// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "benchmark/street_scans.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "facet_mapping/synthetic/street.h"
#include "facet_mapping/synthetic/street_lidar.h"
#include "facet_mapping/synthetic/street_raycaster.h"
#include "facet_mapping/synthetic/street_rig.h"

namespace facet_mapping::benchmarking {
namespace {

constexpr std::size_t kPointsPerFrame = 10000;
constexpr Label kScanLabel = 0;

Street street_for(int frames) {
  StreetConfig config;
  config.frames = frames;
  config.length_m = std::max(60.0, frames * config.frame_spacing_m + kStreetEndMargin);
  return make_street(config);
}

// Every n-th point of a scan, in the map frame.
CarvingFrame frame_of(const std::vector<Eigen::Vector4f>& scan,
                      const Eigen::Isometry3d& map_from_velo,
                      std::size_t wanted) {
  if (scan.size() < wanted) {
    throw std::runtime_error("benchmark: a scan has fewer points than wanted");
  }
  CarvingFrame frame;
  frame.center = map_from_velo.translation();
  for (std::size_t k = 0; k < wanted; ++k) {
    const Eigen::Vector4f& hit = scan[k * scan.size() / wanted];
    frame.rays.push_back(
        {map_from_velo * hit.head<3>().cast<double>(), kScanLabel, /*sigma=*/0.02F});
  }
  return frame;
}

}  // namespace

std::vector<CarvingFrame> street_scans(std::size_t count) {
  const auto frames = static_cast<int>((count + kPointsPerFrame - 1) / kPointsPerFrame);
  const Street street = street_for(frames);
  const StreetRaycaster raycaster(street);
  const Eigen::Isometry3d left_from_velo = kitti_rig(true).left_from_velo;
  std::vector<CarvingFrame> scans;
  for (int k = 0; k < frames; ++k) {
    const Eigen::Isometry3d map_from_velo = street.trajectory.at(k).map_from_left * left_from_velo;
    const std::size_t done = scans.size() * kPointsPerFrame;
    scans.push_back(frame_of(scan_street(street, raycaster, map_from_velo, {}, 100 + k),
                             map_from_velo,
                             std::min(kPointsPerFrame, count - done)));
  }
  return scans;
}

std::vector<CarvingFrame> seen_from_neighbours(const std::vector<CarvingFrame>& frames, int rays) {
  std::vector<CarvingFrame> seen = frames;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (int step = 1; step < rays; ++step) {
      // Back along the drive at its end: these positions saw the points, too.
      const std::size_t other =
          k + step < frames.size() ? k + step : k - std::min<std::size_t>(k, step);
      std::copy(frames[k].rays.begin(), frames[k].rays.end(), std::back_inserter(seen[other].rays));
    }
  }
  return seen;
}

}  // namespace facet_mapping::benchmarking
