// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "facet_mapping/geometry/size_text.h"
#include "facet_mapping/ros/image_conversions.h"

namespace facet_mapping {
namespace {

std::invalid_argument problem(const std::string& topic, const std::string& sentence) {
  return std::invalid_argument("camera_info of '" + topic + "': " + sentence);
}

bool is_distorted(const sensor_msgs::CameraInfo& info) {
  return std::any_of(info.D.begin(), info.D.end(), [](double d) { return d != 0.0; });
}

/// P equals [K 0]: nobody computed a rectified projection.
bool projection_is_raw(const sensor_msgs::CameraInfo& info) {
  return info.P[0] == info.K[0] && info.P[5] == info.K[4] && info.P[2] == info.K[2] &&
         info.P[6] == info.K[5];
}

bool names_raw_image(const std::string& topic) {
  const std::string name = topic.substr(topic.rfind('/') + 1);
  return name.rfind("image_raw", 0) == 0 || name.rfind("image_color", 0) == 0;
}

void check_size(const sensor_msgs::CameraInfo& info,
                const cv::Size& size,
                const std::string& topic) {
  if (info.binning_x > 1 || info.binning_y > 1 || info.roi.x_offset > 0 || info.roi.y_offset > 0) {
    throw problem(topic, "binning and regions of interest are not supported; send full images");
  }
  const bool given = info.width != 0 || info.height != 0;
  if (given && (static_cast<int>(info.width) != size.width ||
                static_cast<int>(info.height) != size.height)) {
    throw problem(topic,
                  "it describes " + size_text(info) + " pixels, but the image " + "has " +
                      size_text(size) + "; calibrate at the size that is published");
  }
}

void check_rectified(const sensor_msgs::CameraInfo& info, const std::string& topic) {
  if (!is_distorted(info)) {
    return;
  }
  if (info.P[0] == 0.0 || projection_is_raw(info) || names_raw_image(topic)) {
    throw problem(topic,
                  "the lens distortion D is not zero and the image looks unrectified; remap "
                  "image_rect to a rectified image (image_proc, stereo_image_proc)");
  }
}

}  // namespace

PinholeCamera camera_from_info(const sensor_msgs::CameraInfo& info,
                               const cv::Size& size,
                               const std::string& topic) {
  check_size(info, size, topic);
  check_rectified(info, topic);
  const bool has_projection = info.P[0] != 0.0;
  PinholeCamera camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = has_projection ? info.P[0] : info.K[0];
  camera.fy = has_projection ? info.P[5] : info.K[4];
  camera.cx = has_projection ? info.P[2] : info.K[2];
  camera.cy = has_projection ? info.P[6] : info.K[5];
  if (!camera.is_valid()) {
    throw problem(topic,
                  "no usable intrinsics (fx " + std::to_string(camera.fx) + ", fy " +
                      std::to_string(camera.fy) +
                      "); calibrate the camera (rosrun camera_calibration cameracalibrator.py) or "
                      "fill K and P");
  }
  return camera;
}

double baseline_from_info(const sensor_msgs::CameraInfo& left,
                          const sensor_msgs::CameraInfo& right) {
  const double fx = right.P[0];
  const double baseline = fx == 0.0 ? 0.0 : (left.P[3] - right.P[3]) / fx;
  if (!std::isfinite(baseline) || baseline == 0.0) {
    throw std::invalid_argument(
        "right/camera_info has no baseline: P[3] must be -fx * baseline (pixels * metres) more "
        "than "
        "that of left/camera_info; calibrate the pair as stereo");
  }
  if (baseline < 0.0) {
    throw std::invalid_argument(
        "the sign of P[3] says that the right camera is on the left (baseline " +
        std::to_string(baseline) + " m): swap the left/ and right/ topics");
  }
  return baseline;
}

}  // namespace facet_mapping
