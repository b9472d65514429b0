// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/stereo_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

#include "stereo_scenes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using test::DisparityPlane;
using test::make_pair;
using test::make_texture;

constexpr double kBaseline = 0.5;  // metres

PinholeCamera make_camera(const cv::Mat& image) {
  return {image.cols, image.rows, 300.0, 310.0, 0.5 * image.cols, 0.45 * image.rows};
}

StereoConfig small_config() {
  StereoConfig config;
  config.num_disparities = 64;
  return config;
}

cv::Point pixel_of(const LabeledPoint& point, const PinholeCamera& camera) {
  const Eigen::Vector2d pixel = camera.project(point.position.cast<double>());
  return {static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))};
}

std::vector<double> disparity_errors(const DisparityPlane& plane) {
  const auto [left, right] = make_pair(320, 160, 1, plane);
  const PinholeCamera camera = make_camera(left);
  std::vector<double> errors;
  for (const LabeledPoint& point :
       stereo_points(left, right, {}, camera, kBaseline, small_config())) {
    const cv::Point pixel = pixel_of(point, camera);
    errors.push_back(camera.fx * kBaseline / point.position.z() - plane.at(pixel.x, pixel.y));
  }
  return errors;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(StereoPoints, LieOnTheSlantedPlane) {
  const std::vector<double> errors = disparity_errors({30.0, -0.05, 0.1});
  ASSERT_GT(errors.size(), 1000U);
  double squares = 0.0;
  for (const double error : errors) {
    EXPECT_LT(std::abs(error), 1.0);
    squares += error * error;
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(errors.size())), 0.1);
}

TEST(StereoPoints, DoNotPreferWholePixels) {
  for (const double fraction : {0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875}) {
    EXPECT_LT(std::abs(mean(disparity_errors({20.0 + fraction, 0.0, 0.0}))), 0.03) << fraction;
    // Near ones were matched at half size.
    EXPECT_LT(std::abs(mean(disparity_errors({54.0 + fraction, 0.0, 0.0}))), 0.03) << fraction;
  }
}

TEST(StereoPoints, CarrySigmaAndTheLabelOfTheirPixel) {
  const auto [left, right] = make_pair(320, 160, 1, {20.0, 0.0, 0.0});
  const PinholeCamera camera = make_camera(left);
  cv::Mat labels(left.size(), CV_16UC1);
  for (int i = 0; i < static_cast<int>(labels.total()); ++i) {
    labels.at<Label>(i / left.cols, i % left.cols) = static_cast<Label>(i % 60000);
  }
  StereoReport report;
  const auto points =
      stereo_points(left, right, labels, camera, kBaseline, small_config(), &report);
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(report.points, points.size());
  EXPECT_GT(report.matched_pixels, left.total() / 2);
  double surest = 10.0;
  for (const LabeledPoint& point : points) {
    EXPECT_EQ(point.label, labels.at<Label>(pixel_of(point, camera)));
    // Never below the least doubt; a perfect pair leaves hardly any other.
    const double depth = point.position.z();
    const double typical = depth * depth * 0.5 / (camera.fx * kBaseline);
    EXPECT_GT(point.sigma, 0.79 * typical);
    EXPECT_LT(point.sigma, 3.0 * typical);
    surest = std::min(surest, point.sigma / typical);
  }
  EXPECT_LT(surest, 1.0);
}

double mean_sigma(const std::vector<LabeledPoint>& points,
                  bool upper,
                  const PinholeCamera& camera) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const LabeledPoint& point : points) {
    if ((pixel_of(point, camera).y < 80) == upper) {
      sum += point.sigma;
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

TEST(StereoPoints, AreLessSureWhereTheImageIsNoisy) {
  const auto [left, right] = make_pair(320, 160, 1, {20.0, 0.0, 0.0});
  cv::Mat noisy = right.clone();
  cv::Mat noise(80, 320, CV_16SC1);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 20.0);
  cv::Mat upper = noisy.rowRange(0, 80);
  cv::add(upper, noise, upper, cv::noArray(), CV_8U);
  const PinholeCamera camera = make_camera(left);
  const auto points = stereo_points(left, noisy, {}, camera, kBaseline, small_config());
  EXPECT_GT(mean_sigma(points, true, camera), 1.1 * mean_sigma(points, false, camera));
}

TEST(StereoPoints, HaveNoClassWithoutLabels) {
  const auto [left, right] = make_pair(200, 100, 1, {20.0, 0.0, 0.0});
  for (const LabeledPoint& point :
       stereo_points(left, right, {}, make_camera(left), kBaseline, small_config())) {
    EXPECT_EQ(point.label, kUnlabelled);
  }
}

TEST(StereoPoints, AreAtMostOnePerCell) {
  const auto [left, right] = make_pair(320, 160, 1, {20.0, 0.0, 0.0});
  const PinholeCamera camera = make_camera(left);
  StereoConfig config = small_config();
  config.cell_px = 9;
  config.min_gradient = 0.0;
  std::set<std::pair<int, int>> cells;
  const auto points = stereo_points(left, right, {}, camera, kBaseline, config);
  for (const LabeledPoint& point : points) {
    const cv::Point pixel = pixel_of(point, camera);
    EXPECT_TRUE(cells.insert({pixel.x / 9, pixel.y / 9}).second);
  }
  EXPECT_GT(points.size(), 300U);
}

TEST(StereoPoints, AreSparserWhereTheImageIsFlat) {
  auto [left, right] = make_pair(320, 160, 1, {20.0, 0.0, 0.0});
  for (cv::Mat flat : {left.rowRange(0, 80), right.rowRange(0, 80)}) {
    flat.convertTo(flat, -1, 0.05, 120.0);
  }
  const PinholeCamera camera = make_camera(left);
  std::size_t in_flat = 0;
  const auto points = stereo_points(left, right, {}, camera, kBaseline, small_config());
  for (const LabeledPoint& point : points) {
    in_flat += pixel_of(point, camera).y < 80 ? 1 : 0;
  }
  EXPECT_GT(in_flat, 50U);
  EXPECT_LT(3 * in_flat, points.size() - in_flat);
}

TEST(StereoPoints, KeepToTheRange) {
  const auto [left, right] = make_pair(320, 160, 1, {10.0, 0.0, 0.25});  // 15 m to 3 m
  const PinholeCamera camera = make_camera(left);
  StereoConfig config = small_config();
  config.min_depth_m = 4.0;
  config.max_relative_sigma = 0.03;  // 9 m
  const auto points = stereo_points(left, right, {}, camera, kBaseline, config);
  ASSERT_GT(points.size(), 300U);
  for (const LabeledPoint& point : points) {
    EXPECT_GE(point.position.z(), 4.0F);
    EXPECT_LE(point.sigma, 0.03F * point.position.z() * 1.0001F);
  }
  config.max_depth_m = 3.0;
  config.min_depth_m = 1.0;
  EXPECT_TRUE(stereo_points(left, right, {}, camera, kBaseline, config).empty());
}

TEST(StereoPoints, AvoidExcludedClasses) {
  const auto [left, right] = make_pair(320, 160, 1, {20.0, 0.0, 0.0});
  cv::Mat labels(left.size(), CV_16UC1, cv::Scalar(3));
  labels.colRange(200, 320).setTo(10);
  StereoConfig config = small_config();
  config.excluded_labels = {10, 11};
  const auto points = stereo_points(left, right, labels, make_camera(left), kBaseline, config);
  ASSERT_GT(points.size(), 300U);
  for (const LabeledPoint& point : points) {
    EXPECT_EQ(point.label, 3);
  }
}

/// A square at disparity 40 before a wall at disparity 15.
TEST(StereoPoints, DoNotFlyBetweenForegroundAndBackground) {
  const cv::Rect square(150, 40, 100, 80);
  const auto [background, background_right] = make_pair(400, 160, 1, {15.0, 0.0, 0.0});
  const cv::Mat foreground = make_texture(400, 160, 2);
  cv::Mat left = background.clone();
  foreground(square).copyTo(left(square));
  cv::Mat right = background_right.clone();
  foreground(square).copyTo(right(square - cv::Point(40, 0)));
  const PinholeCamera camera = make_camera(left);
  const auto points = stereo_points(left, right, {}, camera, kBaseline, small_config());
  std::size_t on_square = 0;
  std::size_t misplaced = 0;
  for (const LabeledPoint& point : points) {
    const double disparity = camera.fx * kBaseline / point.position.z();
    const bool near = std::abs(disparity - 40.0) < 1.0;
    EXPECT_TRUE(near || std::abs(disparity - 15.0) < 1.0) << disparity;
    on_square += near ? 1 : 0;
    misplaced += near != square.contains(pixel_of(point, camera)) ? 1 : 0;
  }
  EXPECT_GT(on_square, 150U);
  EXPECT_GT(points.size() - on_square, 600U);
  EXPECT_LE(misplaced, points.size() / 200);
}

TEST(StereoPoints, AreNoneWithoutTextureOrPixels) {
  const cv::Mat grey(100, 200, CV_8UC1, cv::Scalar(90));
  EXPECT_TRUE(stereo_points(grey, grey, {}, make_camera(grey), kBaseline, small_config()).empty());
  StereoReport report;
  EXPECT_TRUE(
      stereo_points({}, {}, {}, PinholeCamera(), kBaseline, small_config(), &report).empty());
  EXPECT_EQ(report.matched_pixels, 0U);
}

TEST(StereoPoints, AreNearlyNoneForSwappedImages) {
  const auto [left, right] = make_pair(320, 160, 1, {20.0, 0.0, 0.0});
  const PinholeCamera camera = make_camera(left);
  const auto right_way = stereo_points(left, right, {}, camera, kBaseline, small_config());
  const auto swapped = stereo_points(right, left, {}, camera, kBaseline, small_config());
  EXPECT_LT(20 * swapped.size(), right_way.size());
}

TEST(StereoPoints, RefuseWhatDoesNotFitTheImage) {
  const cv::Mat left = make_texture(100, 80, 1);
  const PinholeCamera camera = make_camera(left);
  const StereoConfig config = small_config();
  const cv::Mat small_labels(40, 50, CV_16UC1, cv::Scalar(0));
  const cv::Mat wrong_labels(80, 100, CV_8UC1, cv::Scalar(0));
  EXPECT_THROW(stereo_points(left, left, small_labels, camera, kBaseline, config),
               std::invalid_argument);
  EXPECT_THROW(stereo_points(left, left, wrong_labels, camera, kBaseline, config),
               std::invalid_argument);
  EXPECT_THROW(stereo_points(left, left, {}, camera, 0.0, config), std::invalid_argument);
  EXPECT_THROW(stereo_points(left, left, {}, camera, -0.5, config), std::invalid_argument);
  EXPECT_THROW(stereo_points(left, left, {}, PinholeCamera(), kBaseline, config),
               std::invalid_argument);
  EXPECT_THROW(stereo_points(left, left, {}, camera.resized(50, 40), kBaseline, config),
               std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
