// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points with a class, as every source (stereo, LiDAR, tracks, sweeping) hands them to the map.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping {

struct LabeledPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< sensor frame, metres
  Label label = kUnlabelled;
  float sigma = 0.0F;  ///< standard deviation along the viewing ray, metres; 0 = unknown
};

/// The points of one sensor at one instant; every ray starts at the sensor's origin.
struct PointFrame {
  double stamp = 0.0;  ///< seconds
  Eigen::Isometry3d world_from_sensor = Eigen::Isometry3d::Identity();
  std::vector<LabeledPoint> points;
};

}  // namespace facet_mapping
