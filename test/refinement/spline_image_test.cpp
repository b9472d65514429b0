// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/spline_image.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

cv::Mat random_image(int rows, int cols) {
  cv::Mat image(rows, cols, CV_32FC1);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0.0, 255.0);
  return image;
}

TEST(SplineImage, GradientIsTheDerivativeOfTheValue) {
  const SplineImage image(random_image(12, 15));
  constexpr double kStep = 1e-2;
  for (double y = 1.3; y < 9.0; y += 0.71) {
    for (double x = 1.3; x < 12.0; x += 0.83) {
      const ImageSample s = image.sample(x, y);
      const double dx = image.sample(x + kStep, y).value - image.sample(x - kStep, y).value;
      const double dy = image.sample(x, y + kStep).value - image.sample(x, y - kStep).value;
      EXPECT_NEAR(s.dx, dx / (2.0 * kStep), 0.1);
      EXPECT_NEAR(s.dy, dy / (2.0 * kStep), 0.1);
    }
  }
}

TEST(SplineImage, ReproducesALinearImageEverywhere) {
  cv::Mat image(10, 10, CV_32FC1);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      image.at<float>(y, x) = static_cast<float>(3 * x - 2 * y + 5);
    }
  }
  const SplineImage spline(image);
  const ImageSample s = spline.sample(4.37, 5.81);
  EXPECT_NEAR(s.value, 3 * 4.37 - 2 * 5.81 + 5, 1e-4);
  EXPECT_NEAR(s.dx, 3.0, 1e-5);
  EXPECT_NEAR(s.dy, -2.0, 1e-5);
}

TEST(SplineImage, PixelImageEqualsTheSplineAtThePixels) {
  const SplineImage spline(random_image(9, 11));
  const cv::Mat pixels = spline.at_pixels();
  for (int y = 1; y < 7; ++y) {
    for (int x = 1; x < 9; ++x) {
      EXPECT_NEAR(pixels.at<float>(y, x), spline.sample(x, y).value, 1e-3);
    }
  }
}

TEST(SplineImage, KnowsWhereItCanBeSampled) {
  const SplineImage spline(random_image(9, 11));
  EXPECT_TRUE(spline.contains(1.0, 1.0));
  EXPECT_TRUE(spline.contains(8.99, 6.99));
  EXPECT_FALSE(spline.contains(0.99, 3.0));
  EXPECT_FALSE(spline.contains(9.0, 3.0));
  EXPECT_FALSE(spline.contains(3.0, 7.0));
}

TEST(SplineImage, RefusesColour) {
  EXPECT_THROW(SplineImage(cv::Mat::zeros(4, 4, CV_8UC3)), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
