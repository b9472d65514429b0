// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/scan_depth.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace facet_mapping {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();

// The nearest depth in each pixel, kFar where there is no point.
cv::Mat nearest_points(const std::vector<Eigen::Vector4f>& points,
                       const Eigen::Isometry3d& cam_from_scanner,
                       const PinholeCamera& camera) {
  cv::Mat depth(camera.height, camera.width, CV_32F, cv::Scalar(kFar));
  constexpr double kNear = 0.1;  // metres
  for (const Eigen::Vector4f& record : points) {
    const Eigen::Vector3d point = cam_from_scanner * record.head<3>().cast<double>();
    if (!point.allFinite() || point.z() < kNear) {
      continue;
    }
    const Eigen::Vector2d pixel = camera.project(point);
    const double column = std::round(pixel.x());
    const double row = std::round(pixel.y());
    if (column >= 0.0 && row >= 0.0 && column < camera.width && row < camera.height) {
      auto& nearest = depth.at<float>(static_cast<int>(row), static_cast<int>(column));
      nearest = std::min(nearest, static_cast<float>(point.z()));
    }
  }
  return depth;
}

}  // namespace

cv::Mat scan_depth(const std::vector<Eigen::Vector4f>& points,
                   const Eigen::Isometry3d& cam_from_scanner,
                   const PinholeCamera& camera,
                   const ScanDepthOptions& options) {
  if (!camera.is_valid()) {
    throw std::invalid_argument("scan depth: the camera has no size or no focal length");
  }
  const cv::Mat nearest = nearest_points(points, cam_from_scanner, camera);
  cv::Mat foreground;
  cv::erode(nearest,
            foreground,
            cv::getStructuringElement(
                cv::MORPH_RECT,
                {2 * options.window_half_width_px + 1, 2 * options.window_half_height_px + 1}));
  const cv::Mat occluded = foreground < nearest * options.nearer_ratio;
  cv::Mat depth = nearest.clone();
  depth.setTo(cv::Scalar(0.0F), occluded);
  depth.setTo(cv::Scalar(0.0F), nearest == kFar);
  return depth;
}

}  // namespace facet_mapping
