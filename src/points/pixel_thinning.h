// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the pixels that become points.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace facet_mapping::detail {

struct ThinningConfig {
  int cell_px = 6;
  int flat_cell_px = 18;
  double min_gradient = 8.0;
};

/// Grey-value gradient of an 8-bit image, CV_32F, grey values per pixel.
cv::Mat gradient_magnitude(const cv::Mat& gray);

/// CV_8UC1, non-zero within `margin_px` of a jump of the disparity by more than `jump_px`, or of a
/// hole in it. There the matcher's window mixes two surfaces and points fly between them.
cv::Mat find_depth_edges(const cv::Mat& disparity, double jump_px, int margin_px);

/// At most one usable pixel per cell: the one of strongest gradient. Where no usable pixel reaches
/// `min_gradient`, cells are `flat_cell_px` large. Row by row, so that equal input gives equal
/// order.
std::vector<cv::Point> thin_pixels(const cv::Mat& usable,
                                   const cv::Mat& gradient,
                                   const ThinningConfig& config);

}  // namespace facet_mapping::detail
