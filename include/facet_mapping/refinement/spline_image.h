// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth continuous image: what makes the photometric energy differentiable.
#pragma once

#include <array>

#include <opencv2/core.hpp>

namespace facet_mapping {

struct ImageSample {
  float value = 0.0F;
  float dx = 0.0F;  ///< derivative along the columns, per pixel
  float dy = 0.0F;  ///< derivative along the rows, per pixel
};

/// The cubic B-spline's weights of the four pixels around a position at fraction `t` (0..1) between
/// the second and the third, and their derivatives.
struct CubicBasis {
  std::array<float, 4> weight;
  std::array<float, 4> slope;

  explicit CubicBasis(float t);
};

/// The uniform cubic B-spline whose coefficients are the pixels. It is twice differentiable and
/// blurs by the same small amount (variance 1/3 pixel^2) at every sub-pixel position, so that it
/// prefers no position over another, as bilinear sampling would.
class SplineImage {
 public:
  SplineImage() = default;

  /// Takes a CV_8UC1 or CV_32FC1 image. Throws std::invalid_argument on any other type.
  explicit SplineImage(const cv::Mat& image);

  /// True where the 4 x 4 pixels that a sample needs exist.
  bool contains(double x, double y) const {
    return x >= 1.0 && y >= 1.0 && x < pixels_.cols - 2 && y < pixels_.rows - 2;
  }

  /// Value and exact gradient of the spline; the caller makes sure that contains(x, y).
  ImageSample sample(double x, double y) const;

  /// CV_32FC1: the spline at the pixel centres, so that both images of a pair are blurred alike.
  cv::Mat at_pixels() const;

 private:
  cv::Mat pixels_;  // CV_32FC1
};

}  // namespace facet_mapping
