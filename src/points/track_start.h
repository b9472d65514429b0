// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where new tracks start.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/points/track_points.h"

namespace facet_mapping::detail {

/// The image with its local mean and contrast evened out, CV_8UC1, so that flow does not depend on
/// the exposure.
cv::Mat even_image(const cv::Mat& gray);

/// Unit normal of the edge at a pixel (nearest); zero where the image is flat.
Eigen::Vector2d edge_normal(const cv::Mat& gray, const Eigen::Vector2d& pixel);

struct NewFeatures {
  std::vector<Eigen::Vector2d> corners;
  std::vector<Eigen::Vector2d> edges;
};

/// Corners and edge points away from the pixels that are followed already, from the border and
/// from excluded classes.
NewFeatures find_features(const cv::Mat& gray,
                          const cv::Mat& even,
                          const cv::Mat& labels,
                          const std::vector<Eigen::Vector2d>& taken,
                          const TrackConfig& config);

}  // namespace facet_mapping::detail
