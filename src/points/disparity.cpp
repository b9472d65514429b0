// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "stereo_checks.h"
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/points/stereo_points.h"

namespace facet_mapping {
namespace {

constexpr int kStepsPerPixel = cv::StereoMatcher::DISP_SCALE;  // of OpenCV's fixed-point disparity
constexpr std::int16_t kInvalid = -kStepsPerPixel;             // what OpenCV writes for "none"
constexpr int kPrefilterCap = 63;
constexpr int kHalfBlockSize = 3;  // matching window at half size
constexpr int kRangeStep = 16;     // OpenCV's search range is a multiple of it
constexpr int kRangeOverlap = 2;   // pixels below the end of the range where a match is in doubt
constexpr int kSameSurface = 16;   // steps; neighbours at half size closer than it interpolate

/// Fixed-point disparities (CV_16SC1, 1/16 pixel) of the first image's pixels; matches lie to the
/// left in the second image, as far as `disparities` says.
cv::Mat match(const cv::Mat& first,
              const cv::Mat& second,
              const cv::Range& disparities,
              int block_size,
              int uniqueness_percent) {
  // The matcher gives nothing in as many first columns as the range ends at, so these are added.
  // ISOLATED: the images may be parts of larger ones.
  cv::Mat wide_first;
  cv::Mat wide_second;
  cv::copyMakeBorder(
      first, wide_first, 0, 0, disparities.end, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  cv::copyMakeBorder(
      second, wide_second, 0, 0, disparities.end, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  const int area = block_size * block_size;
  const auto matcher = cv::StereoSGBM::create(disparities.start,
                                              disparities.size(),
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
  if (disparities.start > 0) {  // else OpenCV's "none" is kInvalid already
    disparity.setTo(kInvalid, disparity < disparities.start * kStepsPerPixel);
  }
  return disparity.colRange(disparities.end, disparity.cols);
}

cv::Mat half_size(const cv::Mat& image) {
  cv::Mat small;
  const cv::Size size((image.cols + 1) / 2, (image.rows + 1) / 2);
  cv::resize(image, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

cv::Mat mirror(const cv::Mat& image) {
  cv::Mat mirrored;
  cv::flip(image, mirrored, 1);
  return mirrored;
}

/// Half the search range, as OpenCV takes it.
int half_range(int num_disparities) {
  return (num_disparities / 2 + kRangeStep - 1) / kRangeStep * kRangeStep;
}

/// Disparities of the pair at half size, in 1/16 of a half-size pixel.
struct HalfSize {
  cv::Mat left;   // of the left image's pixels
  cv::Mat right;  // of the right image's pixels
};

/// Half size costs an eighth and finds the same occlusions.
HalfSize match_half_size(const cv::Mat& left, const cv::Mat& right, const StereoConfig& config) {
  const cv::Mat small_left = half_size(left);
  const cv::Mat small_right = half_size(right);
  const cv::Range range(0, half_range(config.num_disparities));
  // What is farther is matched at full size; a step less, since at its ends a search is in doubt.
  const cv::Range near(std::max(range.end / 2 / kRangeStep - 1, 0) * kRangeStep, range.end);
  // Mirrored, the right image takes the left one's place and matches lie to the left again.
  cv::Mat near_left =
      match(small_left, small_right, near, kHalfBlockSize, config.uniqueness_percent);
  near_left.setTo(kInvalid, near_left * 2 >= config.num_disparities * kStepsPerPixel);
  return {near_left,
          mirror(match(mirror(small_right), mirror(small_left), range, kHalfBlockSize, 0))};
}

/// Disparities of half size for pixels of full size; linear within a surface, nearest at its edge.
cv::Mat enlarge(const cv::Mat& half, const cv::Size& size) {
  cv::Mat linear;
  cv::Mat nearest;
  const cv::Mat doubled = 2 * half;
  const cv::Size twice(2 * half.cols, 2 * half.rows);  // one more than an odd size
  cv::resize(doubled, linear, twice, 0, 0, cv::INTER_LINEAR);
  cv::resize(doubled, nearest, twice, 0, 0, cv::INTER_NEAREST);
  for (int y = 0; y < twice.height; ++y) {
    auto* row = nearest.ptr<std::int16_t>(y);
    const auto* linear_row = linear.ptr<std::int16_t>(y);
    for (int x = 0; x < twice.width; ++x) {
      row[x] = std::abs(linear_row[x] - row[x]) <= kSameSurface ? linear_row[x] : row[x];
    }
  }
  return nearest(cv::Rect({0, 0}, size));
}

/// Whether the right image's pixel (its row at half size) finds back to the left one's at x.
bool is_confirmed(int disparity, int x, const std::int16_t* reverse_row, int tolerance) {
  const int right_x = (x * kStepsPerPixel - disparity + kStepsPerPixel / 2) / kStepsPerPixel;
  if (disparity <= 0 || right_x < 0) {
    return false;
  }
  const int back = reverse_row[right_x / 2];
  return back > 0 && std::abs(2 * back - disparity) <= tolerance;
}

/// What the reverse direction confirms: of `fine` below `least_near`, else of `near` from there on.
void combine_confirmed(cv::Mat& fine,
                       const cv::Mat& near,
                       int least_near,
                       const cv::Mat& reverse,
                       double tolerance_px) {
  const auto tolerance = static_cast<int>(std::lround(tolerance_px * kStepsPerPixel));
  for (int y = 0; y < fine.rows; ++y) {
    auto* row = fine.ptr<std::int16_t>(y);
    const auto* near_row = near.ptr<std::int16_t>(y);
    const auto* reverse_row = reverse.ptr<std::int16_t>(y / 2);
    for (int x = 0; x < fine.cols; ++x) {
      if (row[x] >= least_near || !is_confirmed(row[x], x, reverse_row, tolerance)) {
        const bool is_near =
            near_row[x] >= least_near && is_confirmed(near_row[x], x, reverse_row, tolerance);
        row[x] = is_near ? near_row[x] : kInvalid;
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
  const int smallest = std::max(config.block_size, 2 * kHalfBlockSize);
  if (left.cols < smallest || left.rows < smallest) {
    return {left.size(), CV_32F, cv::Scalar(std::numeric_limits<double>::quiet_NaN())};
  }
  const HalfSize half = match_half_size(left, right, config);
  // Half the range costs half the time; what is nearer is as precise in depth at half size.
  const int fine_range = half_range(config.num_disparities);
  cv::Mat disparity =
      match(left, right, {0, fine_range}, config.block_size, config.uniqueness_percent).clone();
  combine_confirmed(disparity,
                    enlarge(half.left, left.size()),
                    (fine_range - kRangeOverlap) * kStepsPerPixel,
                    half.right,
                    config.left_right_tolerance_px);
  if (config.speckle_size_px > 0) {
    cv::filterSpeckles(disparity, kInvalid, config.speckle_size_px, kStepsPerPixel);
  }
  return to_pixels(disparity);
}

}  // namespace facet_mapping
