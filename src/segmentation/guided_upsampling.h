// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Values of cells brought to the pixels of an image along its edges.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace facet_mapping::detail {

/// The guided filter computed on a coarse grid (He et al., "Guided image filtering", 2013; "Fast
/// guided filter", 2015): in each neighbourhood a value is a linear function of the grey image.
class GuidedUpsampling {
 public:
  /// `gray`: CV_32FC1 0..1; `radius` in cells; `edge`: grey steps well above it are kept.
  GuidedUpsampling(const cv::Mat& gray, const cv::Size& cells, int radius, double edge);

  /// CV_32FC1 of the image's size from CV_32FC1 of the cells'.
  cv::Mat upsample(const cv::Mat& values) const;

 private:
  cv::Mat mean(const cv::Mat& cells) const;

  cv::Mat gray_;
  cv::Size window_;
  double edge_variance_;
  cv::Mat coarse_;
  cv::Mat coarse_mean_;
  cv::Mat coarse_variance_;
};

}  // namespace facet_mapping::detail
