// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refinement of single disparities; part of stereo_points.
#pragma once

#include <opencv2/core.hpp>

namespace facet_mapping::detail {

struct RefinedDisparity {
  float disparity = 0.0F;  // pixels, NaN where the two windows do not look alike after all
  float doubt = 0.0F;      // standard deviation in units of the noise of a typical match
};

/// The doubt of the surest match: part of the noise is not the window's (rectification).
constexpr float kLeastDoubt = 0.8F;

/// Refines the disparity at `pixel` by least squares on the grey values of a window (Lucas & Kanade
/// 1981, one unknown plus a brightness offset, the window slanted as the disparities around it
/// are). Semi-global matching prefers whole pixels, which makes steps in a road; this does not.
/// Gives the given disparity where there is too little texture to say better. The doubt comes from
/// the curvature of the cost and its rest (the Cramer-Rao bound) and from the share of the window
/// that lies on the same surface.
RefinedDisparity refine_disparity(const cv::Mat& left,
                                  const cv::Mat& right,
                                  const cv::Mat& disparity,
                                  const cv::Point& pixel);

}  // namespace facet_mapping::detail
