// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/lidar_points.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using Scan = std::vector<Eigen::Vector3f>;

/// Points on a wall 10 m ahead of the sensor (x forward), a few centimetres apart.
Scan make_wall(int count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-2.0F, 2.0F);
  std::normal_distribution<float> noise(0.0F, 0.02F);
  Scan scan;
  for (int i = 0; i < count; ++i) {
    scan.emplace_back(10.0F + noise(random), place(random), place(random));
  }
  return scan;
}

TEST(ThinCloud, KeepsMeasuredPointsInOrderOnePerVoxel) {
  const Scan scan = make_wall(5000);
  CloudConfig config;
  config.voxel_m = 0.25;
  CloudReport report;
  const std::vector<LabeledPoint> points = thin_cloud(scan, config, &report);
  auto next = scan.begin();
  std::set<std::array<int, 3>> voxels;
  for (const LabeledPoint& point : points) {
    next = std::find(next, scan.end(), point.position);
    ASSERT_NE(next, scan.end()) << "not a point of the scan, or out of order";
    ++next;
    const Eigen::Array3f cell = (point.position.array() / 0.25F).floor();
    EXPECT_TRUE(voxels
                    .insert({static_cast<int>(cell.x()),
                             static_cast<int>(cell.y()),
                             static_cast<int>(cell.z())})
                    .second);
    EXPECT_EQ(point.label, kUnlabelled);
    EXPECT_FLOAT_EQ(point.sigma, 0.03F);
  }
  EXPECT_GE(points.size(), 256U);  // a wall of 16 x 16 cells
  EXPECT_EQ(report.points, points.size());
  EXPECT_EQ(report.points + report.thinned + report.isolated, scan.size());
}

TEST(ThinCloud, SurvivesPointsThatAreNone) {
  Scan scan = make_wall(500);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const float huge = std::numeric_limits<float>::max();
  scan.insert(scan.begin(), {{nan, 0, 0}, {10, nan, 0}, {10, 0, infinity}, {-infinity, nan, 0}});
  scan.insert(scan.end(), {{0, 0, 0}, {0.5F, 0, 0}, {200, 0, 0}, {huge, huge, huge}});
  CloudReport report;
  const std::vector<LabeledPoint> points = thin_cloud(scan, {}, &report);
  EXPECT_EQ(report.not_finite, 4U);
  EXPECT_EQ(report.out_of_range, 4U);
  EXPECT_GT(points.size(), 200U);
  for (const LabeledPoint& point : points) {
    EXPECT_TRUE(point.position.allFinite());
  }
  EXPECT_TRUE(thin_cloud({}, {}).empty());
  EXPECT_TRUE(thin_cloud({{nan, nan, nan}}, {}).empty());
}

TEST(ThinCloud, DropsIsolatedPointsOnly) {
  Scan scan = make_wall(3000);
  scan.emplace_back(5.0F, 0.0F, 0.0F);
  scan.emplace_back(7.0F, 1.0F, 0.0F);
  CloudConfig config;
  config.voxel_m = 0.0;
  CloudReport report;
  const std::vector<LabeledPoint> points = thin_cloud(scan, config, &report);
  EXPECT_EQ(report.isolated, 2U);
  EXPECT_EQ(points.size(), scan.size() - 2);
  config.outlier_radius_m = 0.0;
  EXPECT_EQ(thin_cloud(scan, config).size(), scan.size());
}

TEST(ThinCloud, TakesWideScansAndFineVoxels) {
  Scan scan;
  for (int i = 0; i < 1000; ++i) {
    const auto x = static_cast<float>(i) * 9.0F - 4500.0F;
    scan.emplace_back(x, -x, 300.0F);
  }
  CloudConfig config;
  config.max_range_m = 1e4;
  config.outlier_radius_m = 0.0;
  config.voxel_m = 0.01;
  EXPECT_EQ(thin_cloud(scan, config).size(), scan.size());
}

TEST(ThinCloud, NamesFieldsOutOfRange) {
  CloudConfig config;
  config.voxel_m = -1.0;
  config.outlier_neighbors = -1;
  try {
    thin_cloud({}, config);
    FAIL() << "nothing thrown";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("voxel_m"), std::string::npos);
    EXPECT_NE(message.find("outlier_neighbors"), std::string::npos);
  }
}

class LabelFromImage : public testing::Test {
 protected:
  LabelFromImage() : labels_(60, 80, CV_16UC1, cv::Scalar(1)) {
    labels_.colRange(40, 80).setTo(2);
    // Sensor x forward, y left, z up; camera 0.5 m above it.
    cam_from_sensor_.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    cam_from_sensor_.translation() = Eigen::Vector3d(0.0, 0.5, 0.0);
  }

  static LabeledPoint at(float x, float y, float z) {
    LabeledPoint point;
    point.position = {x, y, z};
    return point;
  }

  std::size_t label(std::vector<LabeledPoint>& points) const {
    return label_points_from_image(points, cam_from_sensor_, camera_, labels_, config_);
  }

  PinholeCamera camera_{80, 60, 50.0, 50.0, 39.5, 29.5};
  cv::Mat labels_;
  Eigen::Isometry3d cam_from_sensor_ = Eigen::Isometry3d::Identity();
  ImageLabelConfig config_;
};

TEST_F(LabelFromImage, TakesTheNearestPixel) {
  // Column 40.0 is the first of class 2; the border of the pixel areas is 39.5, straight ahead.
  std::vector<LabeledPoint> points{at(10, 0.01F, 0.5F), at(10, -0.01F, 0.5F)};
  EXPECT_EQ(label(points), 2U);
  EXPECT_EQ(points[0].label, 1);
  EXPECT_EQ(points[1].label, 2);
}

TEST_F(LabelFromImage, KeepsWhatTheCameraDoesNotSee) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<LabeledPoint> points{
      at(-10, 0, 0), at(10, 20, 0), at(10, 0, -20), at(0, 0, 0.5F), at(nan, 0, 0)};
  points[1].label = 7;
  EXPECT_EQ(label(points), 0U);
  EXPECT_EQ(points[0].label, kUnlabelled);
  EXPECT_EQ(points[1].label, 7);
}

TEST_F(LabelFromImage, SeesUpToTheBorderOfTheOuterPixels) {
  const auto at_column = [](double column) {
    return at(10.0F, static_cast<float>(-(column - 39.5) / 50.0 * 10.0), 0.5F);
  };
  std::vector<LabeledPoint> points{
      at_column(-0.49), at_column(-0.51), at_column(79.49), at_column(79.51)};
  EXPECT_EQ(label(points), 2U);
  EXPECT_EQ(points[0].label, 1);
  EXPECT_EQ(points[1].label, kUnlabelled);
  EXPECT_EQ(points[2].label, 2);
  EXPECT_EQ(points[3].label, kUnlabelled);
}

TEST_F(LabelFromImage, LeavesHiddenPointsAlone) {
  std::vector<LabeledPoint> points{at(20, 1.0F, 0.5F), at(5, 0.25F, 0.5F), at(5.3F, 0.27F, 0.5F)};
  EXPECT_EQ(label(points), 2U);
  EXPECT_EQ(points[0].label, kUnlabelled) << "hidden behind the second point";
  EXPECT_EQ(points[1].label, 1);
  EXPECT_EQ(points[2].label, 1) << "as good as at the same depth";
}

TEST_F(LabelFromImage, HidesBetweenScanLinesButNotBesideAnObject) {
  // A pole's scan lines are 6 px apart; far points are seen between them and 5 px to the right.
  const auto at_pixel = [](double column, double row, float depth) {
    return at(depth,
              static_cast<float>(-(column - 39.5) / 50.0 * depth),
              static_cast<float>(0.5 - (row - 29.5) / 50.0 * depth));
  };
  std::vector<LabeledPoint> points{
      at_pixel(30, 20, 30), at_pixel(35, 20, 30), at_pixel(32, 17, 30)};
  for (const double row : {11.0, 17.0, 23.0, 29.0}) {
    points.push_back(at_pixel(30, row, 5));
  }
  EXPECT_EQ(label(points), 5U);
  EXPECT_EQ(points[0].label, kUnlabelled) << "between two lines";
  EXPECT_EQ(points[1].label, 1) << "beside the pole";
  EXPECT_EQ(points[2].label, kUnlabelled) << "too near to its edge";
  config_.edge_px = 0;
  points[2].label = kUnlabelled;
  label(points);
  EXPECT_EQ(points[2].label, 1);
}

TEST_F(LabelFromImage, RoadDoesNotHideItself) {
  // From 0.5 m above a road, a row apart; depth changes by far more than the margin per row.
  std::vector<LabeledPoint> points;
  for (double row = 31.0; row < 60.0; row += 1.0) {
    const double depth = 0.5 * 50.0 / (row - 29.5);
    points.push_back(at(static_cast<float>(depth), 1e-3F, 0.0F));
  }
  EXPECT_GE(label(points), points.size() - 2) << "but for the last rows before the horizon";
}

TEST_F(LabelFromImage, OtherScansHideToo) {
  std::vector<LabeledPoint> points{at(20, 1.0F, 0.5F), at(20, -8.0F, 0.5F)};
  // Five metres before the camera; this scan's sensor was 2 m farther back.
  const std::vector<LabeledPoint> before{at(7, 0.25F, 0.5F), at(7, 0.0F, 30.0F)};
  Eigen::Isometry3d sensor_from_before = Eigen::Isometry3d::Identity();
  sensor_from_before.translation().x() = -2.0;
  const std::vector<Occluders> occluders{{&before, cam_from_sensor_ * sensor_from_before}};
  EXPECT_EQ(label_points_from_image(points, cam_from_sensor_, camera_, labels_, {}, occluders), 1U);
  EXPECT_EQ(points[0].label, kUnlabelled);
  EXPECT_EQ(points[1].label, 2);
  EXPECT_EQ(before[0].label, kUnlabelled);
  EXPECT_EQ(label(points), 2U) << "alone nothing hides them";
  EXPECT_THROW(label_points_from_image(points, cam_from_sensor_, camera_, labels_, {}, {{}}),
               std::invalid_argument);
}

TEST_F(LabelFromImage, SkipsUnlabelledAndExcludedPixels) {
  labels_.colRange(0, 20).setTo(kUnlabelled);
  config_.excluded_labels = {2};
  std::vector<LabeledPoint> points{at(10, 6.0F, 0.5F), at(10, 1.0F, 0.5F), at(10, -1.0F, 0.5F)};
  EXPECT_EQ(label(points), 1U);
  EXPECT_EQ(points[0].label, kUnlabelled);
  EXPECT_EQ(points[1].label, 1);
  EXPECT_EQ(points[2].label, kUnlabelled);
}

TEST_F(LabelFromImage, RefusesWhatDoesNotFit) {
  std::vector<LabeledPoint> points{at(10, 0, 0)};
  EXPECT_THROW(label_points_from_image(points, cam_from_sensor_, camera_.resized(40, 30), labels_),
               std::invalid_argument);
  EXPECT_THROW(label_points_from_image(points, cam_from_sensor_, PinholeCamera(), labels_),
               std::invalid_argument);
  EXPECT_THROW(label_points_from_image(
                   points, cam_from_sensor_, camera_, cv::Mat(60, 80, CV_8UC1, cv::Scalar(0))),
               std::invalid_argument);
  cam_from_sensor_.linear() *= 2.0;
  EXPECT_THROW(label(points), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
