// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/spline_image.h"

#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace facet_mapping {

CubicBasis::CubicBasis(float t) {
  const float s = 1.0F - t;
  const float t2 = t * t;
  weight = {s * s * s / 6.0F,
            (4.0F - 6.0F * t2 + 3.0F * t2 * t) / 6.0F,
            (1.0F + 3.0F * t + 3.0F * t2 - 3.0F * t2 * t) / 6.0F,
            t2 * t / 6.0F};
  slope = {-0.5F * s * s, 1.5F * t2 - 2.0F * t, 0.5F + t - 1.5F * t2, 0.5F * t2};
}

SplineImage::SplineImage(const cv::Mat& image) {
  if (image.type() != CV_8UC1 && image.type() != CV_32FC1) {
    throw std::invalid_argument("spline image: give a single-channel 8-bit or float image");
  }
  image.convertTo(pixels_, CV_32F);
}

ImageSample SplineImage::sample(double x, double y) const {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const CubicBasis bx(static_cast<float>(x - column));
  const CubicBasis by(static_cast<float>(y - row));
  ImageSample sample;
  for (int k = 0; k < 4; ++k) {
    const float* p = pixels_.ptr<float>(row - 1 + k) + column - 1;
    const float value =
        bx.weight[0] * p[0] + bx.weight[1] * p[1] + bx.weight[2] * p[2] + bx.weight[3] * p[3];
    const float slope =
        bx.slope[0] * p[0] + bx.slope[1] * p[1] + bx.slope[2] * p[2] + bx.slope[3] * p[3];
    sample.value += by.weight[k] * value;
    sample.dx += by.weight[k] * slope;
    sample.dy += by.slope[k] * value;
  }
  return sample;
}

cv::Mat SplineImage::at_pixels() const {
  const cv::Matx13f kernel(1.0F / 6.0F, 4.0F / 6.0F, 1.0F / 6.0F);
  cv::Mat smooth;
  cv::sepFilter2D(
      pixels_, smooth, CV_32F, kernel, kernel, cv::Point(-1, -1), 0.0, cv::BORDER_REPLICATE);
  return smooth;
}

}  // namespace facet_mapping
