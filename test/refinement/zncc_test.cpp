// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/zncc.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace facet_mapping {
namespace {

cv::Mat smooth_noise(int seed) {
  cv::Mat image(40, 50, CV_32FC1);
  cv::RNG random(seed);
  random.fill(image, cv::RNG::UNIFORM, 0.0, 255.0);
  cv::GaussianBlur(image, image, cv::Size(5, 5), 1.2);
  return image;
}

const cv::Mat kAllValid(40, 50, CV_8UC1, cv::Scalar(255));

ZnccResult compare(const cv::Mat& a, const cv::Mat& b, const ZnccConfig& config = {}) {
  return zncc_energy(a, window_stats(a, config.window_px), b, kAllValid, config);
}

TEST(Zncc, VanishesForAffinelyChangedIntensities) {
  const cv::Mat image = smooth_noise(1);
  const ZnccResult result = compare(image, 0.6 * image + 30.0);
  EXPECT_GT(result.pixels, 1000U);
  EXPECT_NEAR(result.energy / static_cast<double>(result.pixels), 0.0, 1e-4);
}

TEST(Zncc, IsTwoForInvertedTexture) {
  const cv::Mat image = smooth_noise(2);
  ZnccConfig config;
  config.noise_gray = 0.0;
  const ZnccResult result = compare(image, 255.0 - image, config);
  EXPECT_NEAR(result.energy / static_cast<double>(result.pixels), 2.0, 1e-3);
}

TEST(Zncc, CountsNothingWhereThereIsNoTexture) {
  const cv::Mat flat(40, 50, CV_32FC1, cv::Scalar(90.0));
  EXPECT_NEAR(compare(flat, smooth_noise(3)).energy, 0.0, 0.1);
}

TEST(Zncc, CountsPixelsWhoseWholeWindowIsValid) {
  const cv::Mat image = smooth_noise(4);
  ZnccConfig config;
  EXPECT_EQ(compare(image, image, config).pixels, 36U * 46U);
  cv::Mat valid = kAllValid.clone();
  valid.at<std::uint8_t>(20, 20) = 0;
  const ZnccResult holed =
      zncc_energy(image, window_stats(image, config.window_px), image, valid, config);
  EXPECT_EQ(holed.pixels, 36U * 46U - 25U);
}

/// The reliability changes with the warped image too: with noise_gray of the order of the texture
/// a derivative that left it out would be far off.
TEST(Zncc, DerivativeAgreesWithFiniteDifferences) {
  for (const double noise : {0.0, 2.0, 15.0}) {
    for (const int window : {3, 5, 9}) {
      ZnccConfig config;
      config.noise_gray = noise;
      config.window_px = window;
      const cv::Mat image = smooth_noise(5);
      const cv::Mat warped = 0.5 * image + 0.5 * smooth_noise(6);
      const cv::Mat direction = smooth_noise(7) - 128.0;
      const ZnccResult here = compare(image, warped, config);
      constexpr double kStep = 1e-2;
      const double difference = (compare(image, warped + kStep * direction, config).energy -
                                 compare(image, warped - kStep * direction, config).energy) /
                                (2.0 * kStep);
      const double analytic = here.derivative.dot(direction);
      EXPECT_NEAR(analytic, difference, 0.01 * std::abs(difference)) << window << " " << noise;
    }
  }
}

TEST(Zncc, CurvatureBoundsTheSecondOrderAtAMatch) {
  ZnccConfig config;
  const cv::Mat image = smooth_noise(8);
  for (int seed = 10; seed < 20; ++seed) {
    const cv::Mat direction = smooth_noise(seed) - 128.0;
    constexpr double kStep = 0.02;
    const ZnccResult here = compare(image, image, config);
    const double second = compare(image, image + kStep * direction, config).energy;
    const double bound = 0.5 * kStep * kStep * here.curvature.dot(direction.mul(direction));
    EXPECT_GT(second, 0.2 * bound);
    EXPECT_LT(second, 1.02 * bound);
  }
}

TEST(Zncc, EnergyAloneIsTheSame) {
  const cv::Mat image = smooth_noise(8);
  const cv::Mat warped = smooth_noise(9);
  const ZnccResult alone =
      zncc_energy(image, window_stats(image, 5), warped, kAllValid, ZnccConfig{}, false);
  EXPECT_EQ(alone.energy, compare(image, warped).energy);
  EXPECT_TRUE(alone.derivative.empty());
}

}  // namespace
}  // namespace facet_mapping
