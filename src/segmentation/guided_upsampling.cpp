// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "guided_upsampling.h"

#include <opencv2/imgproc.hpp>

namespace facet_mapping::detail {

GuidedUpsampling::GuidedUpsampling(const cv::Mat& gray,
                                   const cv::Size& cells,
                                   int radius,
                                   double edge)
    : gray_(gray), window_(2 * radius + 1, 2 * radius + 1), edge_variance_(edge * edge) {
  cv::resize(gray, coarse_, cells, 0.0, 0.0, cv::INTER_AREA);
  coarse_mean_ = mean(coarse_);
  coarse_variance_ = mean(coarse_.mul(coarse_)) - coarse_mean_.mul(coarse_mean_);
}

cv::Mat GuidedUpsampling::mean(const cv::Mat& cells) const {
  cv::Mat result;
  cv::blur(cells, result, window_, {-1, -1}, cv::BORDER_REFLECT);
  return result;
}

cv::Mat GuidedUpsampling::upsample(const cv::Mat& values) const {
  const cv::Mat value_mean = mean(values);
  const cv::Mat covariance = mean(coarse_.mul(values)) - coarse_mean_.mul(value_mean);
  const cv::Mat denominator = coarse_variance_ + edge_variance_;
  const cv::Mat slope = covariance / denominator;
  const cv::Mat offset = value_mean - slope.mul(coarse_mean_);
  cv::Mat fine_slope;
  cv::Mat fine_offset;
  cv::resize(mean(slope), fine_slope, gray_.size(), 0.0, 0.0, cv::INTER_LINEAR);
  cv::resize(mean(offset), fine_offset, gray_.size(), 0.0, 0.0, cv::INTER_LINEAR);
  return fine_slope.mul(gray_) + fine_offset;
}

}  // namespace facet_mapping::detail
