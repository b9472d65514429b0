// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/depth_error.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

cv::Mat row_of(const std::vector<float>& values) {
  return cv::Mat(values, true).reshape(1, 1);
}

DepthErrorOptions options() {
  DepthErrorOptions options;
  options.absolute_bounds_m = {0.15, 0.5};
  options.relative_bounds = {0.05, 0.2};
  return options;
}

// Truth 1 2 4 - 10 8, rendered 1.25 1.5 - 5 10 9: errors +0.25 -0.5 (none) (none) 0 +1.
const std::vector<float> kTruth{1.0F, 2.0F, 4.0F, 0.0F, 10.0F, 8.0F};
const std::vector<float> kRendered{1.25F, 1.5F, 0.0F, 5.0F, 10.0F, 9.0F};

TEST(DepthErrors, HandComputed) {
  DepthErrors errors(options());
  errors.add(row_of(kRendered), row_of(kTruth));
  const DepthScores scores = errors.scores();
  EXPECT_EQ(scores.truth_pixels, 5U);
  EXPECT_EQ(scores.covered_pixels, 4U);
  EXPECT_EQ(scores.counted_pixels, 4U);
  EXPECT_DOUBLE_EQ(scores.completeness, 0.8);
  EXPECT_DOUBLE_EQ(scores.mae_m, 1.75 / 4);
  EXPECT_DOUBLE_EQ(scores.median_m, 0.375);  // of 0 0.25 0.5 1
  EXPECT_DOUBLE_EQ(scores.rms_m, std::sqrt((0.0625 + 0.25 + 1.0) / 4));
  EXPECT_DOUBLE_EQ(scores.bias_m, 0.75 / 4);
  EXPECT_DOUBLE_EQ(scores.trimmed_share, 0.0);
  EXPECT_DOUBLE_EQ(scores.trimmed_mae_m, scores.mae_m);
  // Below 0.15 m: one of five. Below 0.5 m: two (0.5 is not below). Below 5 %: the exact one.
  // Below 20 %: 0 and 1 of 8; 0.25 of 1 and 0.5 of 2 are not.
  EXPECT_EQ(scores.within_absolute, (std::vector<double>{0.2, 0.4}));
  EXPECT_EQ(scores.within_relative, (std::vector<double>{0.2, 0.4}));
}

TEST(DepthErrors, LargeErrorsAndFarTruthAreLeftOut) {
  DepthErrorOptions limited = options();
  limited.max_error_m = 0.5;
  limited.max_depth_m = 9.0;
  DepthErrors errors(limited);
  errors.add(row_of(kRendered), row_of(kTruth));
  const DepthScores scores = errors.scores();
  EXPECT_EQ(scores.truth_pixels, 4U);
  EXPECT_EQ(scores.covered_pixels, 3U);
  EXPECT_EQ(scores.counted_pixels, 1U);
  EXPECT_DOUBLE_EQ(scores.mae_m, 0.25);
  EXPECT_EQ(scores.within_absolute, (std::vector<double>{0.0, 0.25}));
}

TEST(DepthErrors, OutliersAreCutAtTenMedians) {
  // Errors 0.25 (nine times) and 8: median 0.25, so 8 is beyond 2.5.
  std::vector<float> truth(10, 4.0F);
  std::vector<float> rendered(10, 4.25F);
  rendered[3] = 12.0F;
  DepthErrors errors;
  errors.add(row_of(rendered), row_of(truth));
  const DepthScores scores = errors.scores();
  EXPECT_DOUBLE_EQ(scores.median_m, 0.25);
  EXPECT_DOUBLE_EQ(scores.mae_m, (9 * 0.25 + 8) / 10);
  EXPECT_DOUBLE_EQ(scores.trimmed_mae_m, 0.25);
  EXPECT_DOUBLE_EQ(scores.trimmed_rms_m, 0.25);
  EXPECT_DOUBLE_EQ(scores.trimmed_share, 0.1);
}

TEST(DepthErrors, SumOverViewsEqualsOneLargeView) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> depth(-1.0F, 10.0F);
  DepthErrors whole(options());
  DepthErrors sum(options());
  cv::Mat all_rendered;
  cv::Mat all_truth;
  for (int view = 0; view < 5; ++view) {
    cv::Mat rendered(4, 7, CV_32F);
    cv::Mat truth(4, 7, CV_32F);
    for (int k = 0; k < 28; ++k) {
      rendered.at<float>(k / 7, k % 7) = std::max(0.0F, depth(random));
      truth.at<float>(k / 7, k % 7) = std::max(0.0F, depth(random));
    }
    DepthErrors one(options());
    one.add(rendered, truth);
    sum.add(one);
    all_rendered.push_back(rendered);
    all_truth.push_back(truth);
  }
  whole.add(all_rendered, all_truth);
  EXPECT_EQ(whole.scores().truth_pixels, sum.scores().truth_pixels);
  EXPECT_DOUBLE_EQ(whole.scores().mae_m, sum.scores().mae_m);
  EXPECT_DOUBLE_EQ(whole.scores().median_m, sum.scores().median_m);
  EXPECT_EQ(whole.scores().within_absolute, sum.scores().within_absolute);
  EXPECT_EQ(whole.scores().within_relative, sum.scores().within_relative);
}

TEST(DepthErrors, NothingIsNotZero) {
  const DepthScores scores = DepthErrors().scores();
  EXPECT_TRUE(std::isnan(scores.mae_m));
  EXPECT_TRUE(std::isnan(scores.median_m));
  EXPECT_TRUE(std::isnan(scores.completeness));
  EXPECT_TRUE(std::isnan(scores.trimmed_share));
}

TEST(DepthErrors, WrongImagesAreRefused) {
  DepthErrors errors;
  EXPECT_THROW(errors.add(cv::Mat(2, 2, CV_32F), cv::Mat(2, 3, CV_32F)), std::invalid_argument);
  EXPECT_THROW(errors.add(cv::Mat(2, 2, CV_64F), cv::Mat(2, 2, CV_32F)), std::invalid_argument);
  EXPECT_THROW(errors.add(cv::Mat(2, 2, CV_32F), cv::Mat(2, 2, CV_16U)), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
