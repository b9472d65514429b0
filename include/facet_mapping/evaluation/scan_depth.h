// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Ground-truth depth images from LiDAR scans.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

/// The scanner stands elsewhere than the camera, so it sees points that the camera does not: a
/// point is dropped if another one in a window around it is clearly nearer.
struct ScanDepthOptions {
  int window_half_width_px = 4;   ///< columns left and right
  int window_half_height_px = 6;  ///< rows above and below: scan lines are several rows apart
  double nearer_ratio = 0.85;     ///< "clearly nearer": below this share of the point's depth
};

/// Planar depth (CV_32FC1, metres, 0 = none) of the nearest point in each pixel of the camera,
/// without occluded points. `points` are x y z intensity in the scanner's frame; points that are
/// not finite or behind the camera are skipped. Throws std::invalid_argument if the camera is
/// invalid.
cv::Mat scan_depth(const std::vector<Eigen::Vector4f>& points,
                   const Eigen::Isometry3d& cam_from_scanner,
                   const PinholeCamera& camera,
                   const ScanDepthOptions& options = {});

}  // namespace facet_mapping
