// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "stereo_checks.h"
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/points/stereo_points.h"

namespace facet_mapping {
namespace {

constexpr int kStepsPerPixel = cv::StereoMatcher::DISP_SCALE;  // of OpenCV's fixed-point disparity
constexpr std::int16_t kInvalid = -kStepsPerPixel;             // what OpenCV writes for "none"
constexpr int kPrefilterCap = 63;
constexpr int kReverseBlockSize = 3;

/// Fixed-point disparities (CV_16SC1, 1/16 pixel) of the first image's pixels; matches lie to the
/// left in the second image.
cv::Mat match(const cv::Mat& first,
              const cv::Mat& second,
              int num_disparities,
              int block_size,
              int uniqueness_percent) {
  // The matcher gives nothing in its first num_disparities columns, so these are added here.
  // ISOLATED: the images may be parts of larger ones.
  cv::Mat wide_first;
  cv::Mat wide_second;
  cv::copyMakeBorder(
      first, wide_first, 0, 0, num_disparities, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  cv::copyMakeBorder(
      second, wide_second, 0, 0, num_disparities, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  const int area = block_size * block_size;
  const auto matcher = cv::StereoSGBM::create(0,
                                              num_disparities,
                                              block_size,
                                              8 * area,   // small changes: slanted surfaces
                                              32 * area,  // jumps: depth edges
                                              1,
                                              kPrefilterCap,
                                              uniqueness_percent,
                                              0,
                                              0,
                                              cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat disparity;
  matcher->compute(wide_first, wide_second, disparity);
  return disparity.colRange(num_disparities, disparity.cols);
}

/// Disparities of the right image's pixels at half size, in 1/16 of a half-size pixel. Half size
/// costs an eighth and finds the same occlusions.
cv::Mat match_reverse(const cv::Mat& left, const cv::Mat& right, int num_disparities) {
  cv::Mat small_left;
  cv::Mat small_right;
  const cv::Size size((left.cols + 1) / 2, (left.rows + 1) / 2);
  cv::resize(left, small_left, size, 0, 0, cv::INTER_AREA);
  cv::resize(right, small_right, size, 0, 0, cv::INTER_AREA);
  // Mirrored, the right image takes the left one's place and matches lie to the left again.
  cv::flip(small_left, small_left, 1);
  cv::flip(small_right, small_right, 1);
  const int half_range = (num_disparities / 2 + 15) / 16 * 16;
  cv::Mat disparity = match(small_right, small_left, half_range, kReverseBlockSize, 0).clone();
  cv::flip(disparity, disparity, 1);
  return disparity;
}

/// Invalidates what the reverse direction does not confirm.
void check_left_right(cv::Mat& disparity, const cv::Mat& reverse, double tolerance_px) {
  const auto tolerance = static_cast<int>(std::lround(tolerance_px * kStepsPerPixel));
  for (int y = 0; y < disparity.rows; ++y) {
    auto* row = disparity.ptr<std::int16_t>(y);
    const auto* reverse_row = reverse.ptr<std::int16_t>(y / 2);
    for (int x = 0; x < disparity.cols; ++x) {
      const int right_x = (x * kStepsPerPixel - row[x] + kStepsPerPixel / 2) / kStepsPerPixel;
      const bool inside = row[x] > 0 && right_x >= 0;
      const int back = inside ? reverse_row[right_x / 2] : kInvalid;
      if (back <= 0 || std::abs(2 * back - row[x]) > tolerance) {
        row[x] = kInvalid;
      }
    }
  }
}

cv::Mat to_pixels(const cv::Mat& fixed_point) {
  cv::Mat pixels;
  fixed_point.convertTo(pixels, CV_32F, 1.0 / kStepsPerPixel);
  pixels.setTo(std::numeric_limits<float>::quiet_NaN(), fixed_point <= 0);
  return pixels;
}

}  // namespace

cv::Mat stereo_disparity(const cv::Mat& left, const cv::Mat& right, const StereoConfig& config) {
  detail::check_stereo_config(config);
  detail::check_stereo_pair(left, right);
  const int smallest = std::max(config.block_size, 2 * kReverseBlockSize);
  if (left.cols < smallest || left.rows < smallest) {
    return {left.size(), CV_32F, cv::Scalar(std::numeric_limits<double>::quiet_NaN())};
  }
  cv::Mat disparity =
      match(left, right, config.num_disparities, config.block_size, config.uniqueness_percent)
          .clone();
  check_left_right(disparity,
                   match_reverse(left, right, config.num_disparities),
                   config.left_right_tolerance_px);
  if (config.speckle_size_px > 0) {
    cv::filterSpeckles(disparity, kInvalid, config.speckle_size_px, kStepsPerPixel);
  }
  return to_pixels(disparity);
}

}  // namespace facet_mapping
