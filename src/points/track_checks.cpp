// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "track_checks.h"

#include <cmath>
#include <string>

#include "rules.h"

#include "facet_mapping/geometry/size_text.h"

namespace facet_mapping::detail {
namespace {

bool is_positive(double value) {
  return value > 0.0 && std::isfinite(value);
}
bool is_share(double value) {
  return value >= 0.0 && value <= 1.0;
}

}  // namespace

void check_track_config(const TrackConfig& config) {
  Rules rules;
  rules.require(config.corner_cell_px > 0, "corner_cell_px must be positive");
  rules.require(config.edge_cell_px > 0, "edge_cell_px must be positive");
  rules.require(config.min_corner > 0.0 && config.min_corner <= 1.0,
                "min_corner must be above 0 and at most 1");
  rules.require(config.min_gradient > 0.0, "min_gradient must be positive");
  rules.require(config.patch_radius_px > 0 && config.patch_radius_px <= 15,
                "patch_radius_px must be from 1 to 15");
  rules.require(is_share(config.min_likeness), "min_likeness must be from 0 to 1");
  rules.require(is_share(config.min_uniqueness), "min_uniqueness must be from 0 to 1");
  rules.require(is_positive(config.epipolar_tolerance_px),
                "epipolar_tolerance_px must be positive");
  rules.require(is_positive(config.round_trip_px), "round_trip_px must be positive");
  rules.require(config.min_motion_px >= 0.0, "min_motion_px must not be negative");
  rules.require(config.min_observations >= 2, "min_observations must be at least 2");
  rules.require(config.window >= 1 && config.window <= 1000, "window must be from 1 to 1000");
  rules.require(is_positive(config.pixel_sigma), "pixel_sigma must be positive");
  rules.require(is_positive(config.max_reprojection_px), "max_reprojection_px must be positive");
  rules.require(config.min_parallax_deg >= 0.0 && config.min_parallax_deg < 180.0,
                "min_parallax_deg must be from 0 to below 180");
  rules.require(config.max_relative_sigma > 0.0, "max_relative_sigma must be positive");
  rules.require(config.min_depth_m > 0.0 && config.max_depth_m > config.min_depth_m,
                "min_depth_m must be above 0 and below max_depth_m");
  rules.throw_if_broken("The configuration of the feature tracks is not usable: ");
}

void check_track_image(const cv::Mat& gray, const PinholeCamera& camera, const cv::Mat& labels) {
  Rules rules;
  rules.require(!gray.empty() && gray.type() == CV_8UC1, "the image must be 8-bit grey");
  rules.require(camera.is_valid(), "the camera has no valid intrinsics");
  rules.require(gray.cols == camera.width && gray.rows == camera.height,
                "the camera is of size " + size_text(camera) + " but the image of size " +
                    size_text(gray.size()));
  rules.require(labels.empty() || labels.type() == CV_16UC1,
                "the label image must hold 16-bit class ids");
  rules.require(labels.empty() || labels.size() == gray.size(),
                "the label image is " + size_text(labels.size()) + " but the image " +
                    size_text(gray.size()) + "; resize it without interpolation");
  rules.throw_if_broken("The image cannot be followed: ");
}

}  // namespace facet_mapping::detail
