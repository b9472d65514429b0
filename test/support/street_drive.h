// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A drive through the synthetic street with a LiDAR, as frames for the map.
#pragma once

#include <algorithm>
#include <vector>

#include "facet_mapping/points/labeled_point.h"
#include "facet_mapping/synthetic/street.h"
#include "facet_mapping/synthetic/street_lidar.h"
#include "facet_mapping/synthetic/street_raycaster.h"
#include "facet_mapping/synthetic/street_rig.h"

namespace facet_mapping::test {

/// `frames` scans, 1.1 m apart, each thinned to `points` points within `range_m`.
inline std::vector<PointFrame> street_drive(int frames, std::size_t points, double range_m) {
  StreetConfig config;
  config.frames = frames;
  config.length_m = std::max(60.0, frames * config.frame_spacing_m + kStreetEndMargin);
  const Street street = make_street(config);
  const StreetRaycaster raycaster(street);
  StreetLidarConfig lidar;
  lidar.max_range_m = range_m;
  const Eigen::Isometry3d left_from_velo = kitti_rig(true).left_from_velo;
  std::vector<PointFrame> drive;
  for (int k = 0; k < frames; ++k) {
    const StreetPose& pose = street.trajectory.at(static_cast<std::size_t>(k));
    PointFrame frame;
    frame.stamp = 100.0 + pose.stamp;
    frame.world_from_sensor = pose.map_from_left * left_from_velo;
    const auto scan = scan_street(
        street, raycaster, frame.world_from_sensor, lidar, 100U + static_cast<unsigned>(k));
    for (std::size_t n = 0; n < std::min(points, scan.size()); ++n) {
      const Eigen::Vector4f& hit = scan[n * scan.size() / std::min(points, scan.size())];
      frame.points.push_back({hit.head<3>(), street_class::kRoad, 0.02F});
    }
    drive.push_back(std::move(frame));
  }
  return drive;
}

}  // namespace facet_mapping::test
