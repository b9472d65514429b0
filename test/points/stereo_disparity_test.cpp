// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "stereo_scenes.h"
#include <gtest/gtest.h>

#include "facet_mapping/points/stereo_points.h"

namespace facet_mapping {
namespace {

using test::DisparityPlane;
using test::make_pair;
using test::make_texture;

StereoConfig small_config() {
  StereoConfig config;
  config.num_disparities = 64;
  return config;
}

std::size_t count_matched(const cv::Mat& disparity) {
  return static_cast<std::size_t>(cv::countNonZero(disparity == disparity));
}

class DisparityOfPlane : public testing::TestWithParam<DisparityPlane> {};

TEST_P(DisparityOfPlane, IsFound) {
  const DisparityPlane& plane = GetParam();
  const auto [left, right] = make_pair(320, 160, 1, plane);
  const cv::Mat disparity = stereo_disparity(left, right, small_config());
  ASSERT_EQ(disparity.type(), CV_32F);
  ASSERT_EQ(disparity.size(), left.size());
  std::vector<double> errors;
  std::size_t visible = 0;
  for (int y = 0; y < left.rows; ++y) {
    for (int x = 0; x < left.cols; ++x) {
      const double truth = plane.at(x, y);
      visible += x > truth + 4 ? 1 : 0;
      if (disparity.at<float>(y, x) > 0.0F) {
        errors.push_back(std::abs(disparity.at<float>(y, x) - truth));
      }
    }
  }
  ASSERT_GT(errors.size(), 0.9 * static_cast<double>(visible));
  std::sort(errors.begin(), errors.end());
  // The near half of the range is matched at half size.
  EXPECT_LT(errors[errors.size() / 2], plane.at(160, 80) > 32.0 ? 0.5 : 0.15);
  EXPECT_LT(errors[errors.size() * 99 / 100], 1.0);
}

INSTANTIATE_TEST_SUITE_P(Planes,
                         DisparityOfPlane,
                         testing::Values(DisparityPlane{20.0, 0.0, 0.0},
                                         DisparityPlane{17.4, 0.0, 0.0},
                                         DisparityPlane{55.0, 0.0, 0.0},
                                         DisparityPlane{10.0, 0.0, 0.25},
                                         DisparityPlane{12.0, 0.1, 0.0},
                                         DisparityPlane{40.0, -0.08, 0.05}));

TEST(StereoDisparity, IsEmptyBeyondTheSearchRange) {
  const auto [left, right] = make_pair(320, 120, 2, {100.0, 0.0, 0.0});
  EXPECT_LT(count_matched(stereo_disparity(left, right, small_config())), left.total() / 50);
}

TEST(StereoDisparity, IsNearlyEmptyForSwappedImages) {
  const auto [left, right] = make_pair(320, 120, 3, {20.0, 0.0, 0.0});

  EXPECT_LT(count_matched(stereo_disparity(right, left, small_config())), left.total() / 50);
}

TEST(StereoDisparity, IsNearlyEmptyForUnrelatedImages) {
  const cv::Mat left = make_texture(320, 120, 4);
  const cv::Mat right = make_texture(320, 120, 5);
  EXPECT_LT(count_matched(stereo_disparity(left, right, small_config())), left.total() / 50);
}

TEST(StereoDisparity, IsEmptyWithoutTexture) {
  const cv::Mat grey(100, 200, CV_8UC1, cv::Scalar(120));
  EXPECT_EQ(count_matched(stereo_disparity(grey, grey, small_config())), 0U);
}

TEST(StereoDisparity, TakesImagesOfAnySize) {
  for (const int height : {1, 2, 5, 7, 16, 33}) {
    for (const int width : {1, 3, 6, 17, 64, 129}) {
      const cv::Mat left = make_texture(width, height, 6);
      EXPECT_EQ(stereo_disparity(left, left, small_config()).size(), left.size());
    }
  }
  EXPECT_TRUE(stereo_disparity(cv::Mat(), cv::Mat(), small_config()).empty());
}

TEST(StereoDisparity, TakesPartsOfLargerImages) {
  const auto [left, right] = make_pair(320, 160, 7, {20.0, 0.0, 0.0});
  const cv::Rect part(30, 20, 200, 90);
  const cv::Mat whole = stereo_disparity(left(part).clone(), right(part).clone(), small_config());
  const cv::Mat view = stereo_disparity(left(part), right(part), small_config());
  EXPECT_EQ(cv::countNonZero((whole != view) & (whole == whole)), 0);
}

TEST(StereoDisparity, IsTheSameForAnyNumberOfThreads) {
  const auto [left, right] = make_pair(320, 160, 8, {40.0, -0.08, 0.05});

  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat one = stereo_disparity(left, right, small_config());
  cv::setNumThreads(4);
  const cv::Mat four = stereo_disparity(left, right, small_config());
  cv::setNumThreads(threads);
  EXPECT_EQ(cv::countNonZero((one == one) != (four == four)), 0);
  EXPECT_EQ(cv::countNonZero((one != four) & (one == one)), 0);
}

TEST(StereoDisparity, RefusesPairsThatDoNotBelongTogether) {
  const cv::Mat left = make_texture(100, 80, 9);
  const StereoConfig config = small_config();
  EXPECT_THROW(stereo_disparity(left, left.colRange(0, 99), config), std::invalid_argument);
  EXPECT_THROW(stereo_disparity(left, cv::Mat(), config), std::invalid_argument);
  const cv::Mat color(80, 100, CV_8UC3, cv::Scalar(0));
  EXPECT_THROW(stereo_disparity(color, color, config), std::invalid_argument);
  const cv::Mat deep(80, 100, CV_16UC1, cv::Scalar(0));
  EXPECT_THROW(stereo_disparity(deep, deep, config), std::invalid_argument);
}

TEST(StereoDisparity, NamesEveryFieldOutOfRange) {
  const cv::Mat left = make_texture(100, 80, 10);
  StereoConfig config;
  config.num_disparities = 100;
  config.block_size = 4;
  config.cell_px = 0;
  config.max_depth_m = 0.5;
  try {
    stereo_disparity(left, left, config);
    FAIL() << "nothing thrown";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    for (const char* field : {"num_disparities", "block_size", "cell_px", "max_depth_m"}) {
      EXPECT_NE(message.find(field), std::string::npos) << field << " not in " << message;
    }
  }
}

}  // namespace
}  // namespace facet_mapping
