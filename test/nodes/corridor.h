// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A textured corridor (road between two walls, closed by a third) and a stereo camera in it, drawn
// by casting a ray per pixel: exact images, classes and poses for the tests of the nodes.
#pragma once

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/label.h"

namespace facet_mapping::test {

/// Classes of the cityscapes list.
constexpr Label kRoad = 0;
constexpr Label kBuilding = 2;

constexpr double kHalfWidthM = 4.0;
constexpr double kEndM = 16.0;
constexpr double kCameraHeightM = 1.6;
constexpr double kBaselineM = 0.4;

/// The left camera's optical frame looks along +x of the map, `x_m` metres from its origin.
Eigen::Isometry3d map_from_left(double x_m);
Eigen::Isometry3d map_from_right(double x_m);
PinholeCamera corridor_camera();

/// Distance of a point of the map frame from the nearest surface of the corridor, metres.
double distance_to_corridor(const Eigen::Vector3d& point);

cv::Mat draw_gray(const Eigen::Isometry3d& map_from_camera);    ///< CV_8UC1
cv::Mat draw_labels(const Eigen::Isometry3d& map_from_camera);  ///< CV_8UC1 ids

}  // namespace facet_mapping::test
