// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of the lidar_points node.
#pragma once

#include <optional>
#include <string>

#include "facet_mapping/points/lidar_points.h"
#include "facet_mapping/points/lidar_scan.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/parameters.h"

namespace facet_mapping {

/// How a cloud says when each of its points was measured.
struct PointTimeInput {
  std::string field = "auto";  ///< auto, none, or the field's name
  std::optional<TimeUnit> unit;
  double max_scan_s = 0.5;
};

struct LidarPointsNodeConfig {
  SegmentationInput segmentation;
  double segmentation_tolerance_s = 0.1;  ///< of the label image's stamp from the scan's
  PoseInput pose;
  int queue_size = 50;  ///< scans that may wait
  PointTimeInput time;
  double frame_s = 0.0;               ///< clouds are gathered into frames of this length
  double split_m = 1.0;               ///< a scan is cut if the sensor moved more meanwhile
  double pose_step_s = 0.01;          ///< between the poses that tf is asked for
  double max_extrapolation_s = 0.02;  ///< beyond the poses that tf knows
  CloudConfig cloud;
  ImageLabelConfig labels;
  int occluder_scans = 3;  ///< the newest scans, of which all points may hide others
};

/// The table points into the struct, which must outlive it.
ParameterTable parameter_table(LidarPointsNodeConfig* config);

}  // namespace facet_mapping
