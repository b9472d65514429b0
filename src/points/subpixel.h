// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refinement of single disparities; part of stereo_points.
#pragma once

#include <opencv2/core.hpp>

namespace facet_mapping::detail {
struct RefinedDisparity { float disparity = 0; float correlation = 0; float residual = 0; float texture = 0; float move = 0; float support = 0; int state = 0; };

/// Refines the disparity at `pixel` by least squares on the grey values of a window (Lucas & Kanade
/// 1981, one unknown plus a brightness offset, the window slanted as the disparities around it
/// are). Semi-global matching prefers whole pixels, which makes steps in a road; this does not.
/// Returns NaN where the two windows do not look alike after all, and the given disparity where
/// there is too little texture to say better.
RefinedDisparity refine_disparity(const cv::Mat& left,
                       const cv::Mat& right,
                       const cv::Mat& disparity,
                       const cv::Point& pixel);

}  // namespace facet_mapping::detail
