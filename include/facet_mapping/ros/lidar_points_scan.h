// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds of LiDAR drivers as scans with times.
#pragma once

#include <cstddef>
#include <string>

#include <sensor_msgs/PointCloud2.h>

#include "facet_mapping/points/lidar_scan.h"
#include "facet_mapping/ros/lidar_points_node_config.h"

namespace facet_mapping {

struct CloudTimes {
  std::string field;          ///< "" if the cloud has no times
  PointTimes times;           ///< without the offsets, which are in the scan
  std::size_t no_return = 0;  ///< points dropped: not finite, or exactly the origin
};

/// Known fields: `time` (Velodyne, s), `t` (Ouster, ns), `offset_time` (Livox, ns), `time_offset`,
/// `timestamp` (Hesai, RoboSense: Unix time in s; Livox: in ns), `time_stamp`. Points without a
/// return are left out. Throws std::invalid_argument with a sentence on a cloud without x, y and z,
/// without the field that `config` names, or with times that point_times() refuses.
LidarScan scan_from_cloud(const sensor_msgs::PointCloud2& cloud,
                          const PointTimeInput& config,
                          CloudTimes* times = nullptr);

}  // namespace facet_mapping
