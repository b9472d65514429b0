// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo_checks.h"

#include <cmath>
#include <string>

#include "rules.h"

#include "facet_mapping/geometry/size_text.h"

namespace facet_mapping::detail {
void check_stereo_config(const StereoConfig& config) {
  Rules rules;
  rules.require(config.num_disparities > 0 && config.num_disparities % 16 == 0 &&
                    config.num_disparities <= 1024,
                "num_disparities must be a multiple of 16 up to 1024");
  rules.require(config.block_size > 0 && config.block_size % 2 == 1 && config.block_size <= 11,
                "block_size must be odd and at most 11");
  rules.require(config.uniqueness_percent >= 0 && config.uniqueness_percent <= 100,
                "uniqueness_percent must be from 0 to 100");
  rules.require(config.left_right_tolerance_px >= 0.0 && config.left_right_tolerance_px <= 100.0,
                "left_right_tolerance_px must be from 0 to 100");
  rules.require(config.speckle_size_px >= 0, "speckle_size_px must not be negative");
  rules.require(config.edge_margin_px >= 0 && config.edge_margin_px <= 100,
                "edge_margin_px must be from 0 to 100");
  rules.require(config.edge_jump_px > 0.0, "edge_jump_px must be positive");
  rules.require(config.disparity_sigma_px > 0.0 && std::isfinite(config.disparity_sigma_px),
                "disparity_sigma_px must be positive");
  rules.require(config.max_relative_sigma > 0.0, "max_relative_sigma must be positive");
  rules.require(config.min_depth_m >= 0.0 && config.max_depth_m > config.min_depth_m,
                "min_depth_m must be at least 0 and below max_depth_m");
  rules.require(config.cell_px > 0, "cell_px must be positive");
  rules.require(config.flat_cell_px >= config.cell_px, "flat_cell_px must be at least cell_px");
  rules.require(config.min_gradient >= 0.0, "min_gradient must not be negative");
  rules.throw_if_broken("The stereo configuration is not usable: ");
}

void check_stereo_pair(const cv::Mat& left, const cv::Mat& right) {
  Rules rules;
  rules.require(left.size() == right.size(),
                "the left image is " + size_text(left.size()) + ", the right one " +
                    size_text(right.size()) + "; both must be of one rectified pair");
  rules.require(left.empty() || left.type() == CV_8UC1, "the left image must be 8-bit grey");
  rules.require(right.empty() || right.type() == CV_8UC1, "the right image must be 8-bit grey");
  rules.throw_if_broken("The stereo pair is not usable: ");
}

void check_stereo_geometry(const cv::Mat& left,
                           const cv::Mat& labels,
                           const PinholeCamera& camera,
                           double baseline_m) {
  Rules rules;
  const cv::Size camera_size(camera.width, camera.height);
  rules.require(camera.is_valid(), "the camera has no valid intrinsics");
  rules.require(camera_size == left.size(),
                "the camera is of size " + size_text(camera_size) + " but the image of size " +
                    size_text(left.size()));
  rules.require(labels.empty() || labels.type() == CV_16UC1,
                "the label image must hold 16-bit class ids");
  rules.require(labels.empty() || labels.size() == left.size(),
                "the label image is " + size_text(labels.size()) + " but the image " +
                    size_text(left.size()) + "; resize it without interpolation");
  rules.require(baseline_m > 0.0 && std::isfinite(baseline_m),
                "the baseline must be positive (metres, right camera to the right of the left)");
  rules.throw_if_broken("The stereo pair cannot be triangulated: ");
}

}  // namespace facet_mapping::detail
