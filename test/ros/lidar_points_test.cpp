// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds of different drivers, and the label image that a scan gets.
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "facet_mapping/ros/lidar_points_labels.h"
#include "facet_mapping/ros/lidar_points_scan.h"
#include "facet_mapping/ros/lidar_points_worker.h"

namespace facet_mapping {
namespace {

using sensor_msgs::PointField;

constexpr double kStamp = 1.7e9;
constexpr int kPoints = 400;
constexpr double kScanS = 0.1;

/// x y z and one field with the times, on a wall 10 m ahead; `unit`: its units per second.
template <typename Time>
sensor_msgs::PointCloud2 cloud_with(const std::string& name,
                                    std::uint8_t datatype,
                                    double units,
                                    double first_s = 0.0) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = ros::Time(kStamp);
  cloud.header.frame_id = "lidar";
  cloud.height = 1;
  cloud.width = kPoints;
  cloud.point_step = 12 + sizeof(Time);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(cloud.row_step);
  for (const char* axis : {"x", "y", "z"}) {
    PointField field;
    field.name = axis;
    field.offset = static_cast<std::uint32_t>(4 * cloud.fields.size());
    field.datatype = PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.fields.push_back(cloud.fields.back());
  cloud.fields.back().name = name;
  cloud.fields.back().offset = 12;
  cloud.fields.back().datatype = datatype;
  for (int i = 0; i < kPoints; ++i) {
    const float xyz[] = {
        10.0F, 0.1F * static_cast<float>(i % 20), 0.1F * static_cast<float>(i / 20)};
    const auto time = static_cast<Time>((first_s + kScanS * i / (kPoints - 1)) * units);
    std::uint8_t* bytes = cloud.data.data() + static_cast<std::size_t>(i) * cloud.point_step;
    std::memcpy(bytes, xyz, sizeof(xyz));
    std::memcpy(bytes + 12, &time, sizeof(time));
  }
  return cloud;
}

void expect_offsets(const sensor_msgs::PointCloud2& cloud, const std::string& field) {
  CloudTimes times;
  const LidarScan scan = scan_from_cloud(cloud, {}, &times);
  EXPECT_EQ(times.field, field);
  EXPECT_EQ(scan.stamp, kStamp);
  ASSERT_EQ(scan.offsets_s.size(), static_cast<std::size_t>(kPoints)) << field;
  for (int i = 0; i < kPoints; ++i) {
    ASSERT_NEAR(scan.offsets_s[i], kScanS * i / (kPoints - 1), 1e-6) << field;
  }
}

TEST(ScanFromCloud, KnowsTheTimesOfDrivers) {
  expect_offsets(cloud_with<float>("time", PointField::FLOAT32, 1.0), "time");
  expect_offsets(cloud_with<std::uint32_t>("t", PointField::UINT32, 1e9), "t");
  expect_offsets(cloud_with<std::uint32_t>("offset_time", PointField::UINT32, 1e9), "offset_time");
  expect_offsets(cloud_with<double>("timestamp", PointField::FLOAT64, 1.0, kStamp), "timestamp");
  expect_offsets(cloud_with<double>("timestamp", PointField::FLOAT64, 1e9, kStamp), "timestamp");
  expect_offsets(cloud_with<float>("time_offset", PointField::FLOAT32, 1.0), "time_offset");
  expect_offsets(cloud_with<float>("time", PointField::FLOAT32, 1e6), "time");
}

TEST(ScanFromCloud, FieldIsAsConfigured) {
  const auto cloud = cloud_with<float>("when", PointField::FLOAT32, 1.0);
  PointTimeInput input;
  EXPECT_TRUE(scan_from_cloud(cloud, input).offsets_s.empty());
  input.field = "when";
  EXPECT_EQ(scan_from_cloud(cloud, input).offsets_s.size(), static_cast<std::size_t>(kPoints));
  input.field = "tiem";
  EXPECT_THROW(scan_from_cloud(cloud, input), std::invalid_argument);
  input.field = "none";
  EXPECT_TRUE(scan_from_cloud(cloud_with<float>("time", PointField::FLOAT32, 1.0), input)
                  .offsets_s.empty());
}

TEST(ScanFromCloud, LeavesOutWhatDidNotReturn) {
  auto cloud = cloud_with<std::uint32_t>("t", PointField::UINT32, 1e9);
  const float nan[] = {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F};
  const float origin[] = {0.0F, 0.0F, 0.0F};
  std::memcpy(cloud.data.data(), nan, sizeof(nan));
  std::memcpy(cloud.data.data() + cloud.point_step, origin, sizeof(origin));
  CloudTimes times;
  const LidarScan scan = scan_from_cloud(cloud, {}, &times);
  EXPECT_EQ(times.no_return, 2U);
  EXPECT_EQ(scan.points.size(), static_cast<std::size_t>(kPoints - 2));
  EXPECT_NEAR(scan.offsets_s.front(), 2.0 * kScanS / (kPoints - 1), 1e-6);
}

class NearestLabelsTest : public testing::Test {
 protected:
  void add_image(double stamp) {
    labels_.add_image(ros::Time(stamp), boost::make_shared<int>(1), now_);
  }
  bool add_scan(double stamp) {
    return labels_.add_scan(
        ros::Time(stamp), now_, [this](const auto& image) { got_.push_back(image); });
  }

  NearestLabels labels_{{0.1, 2.0, 5.0, 3}};
  ros::WallTime now_{1000.0};
  std::vector<NearestLabels::Image> got_;
};

TEST_F(NearestLabelsTest, TakesTheNearerOfTwo) {
  add_image(10.0);
  EXPECT_TRUE(add_scan(10.03));
  EXPECT_TRUE(add_scan(10.08));
  EXPECT_TRUE(got_.empty()) << "a nearer image may follow";
  add_image(10.1);
  ASSERT_EQ(got_.size(), 2U);
  EXPECT_EQ(got_[0].stamp, ros::Time(10.0));
  EXPECT_EQ(got_[1].stamp, ros::Time(10.1));
}

TEST_F(NearestLabelsTest, TimeOutGivesWhatThereIs) {
  add_image(10.0);
  EXPECT_TRUE(add_scan(10.05));
  EXPECT_TRUE(add_scan(10.2));
  now_ += ros::WallDuration(2.1);
  labels_.poll(now_);
  ASSERT_EQ(got_.size(), 2U);
  EXPECT_NE(got_[0].message, nullptr);
  EXPECT_EQ(got_[1].message, nullptr) << "beyond the tolerance";
}

TEST_F(NearestLabelsTest, BoundsAndClear) {
  EXPECT_TRUE(add_scan(1.0));
  EXPECT_TRUE(add_scan(2.0));
  EXPECT_TRUE(add_scan(3.0));
  EXPECT_FALSE(add_scan(4.0));
  labels_.clear();
  EXPECT_EQ(labels_.waiting(), 0U);
  add_image(9.0);
  EXPECT_TRUE(got_.empty());
  now_ += ros::WallDuration(6.0);
  labels_.poll(now_);  // forgets the image
  EXPECT_TRUE(add_scan(9.0));
  EXPECT_TRUE(got_.empty());
}

TEST(LidarPointsWorker, EarlierScansHideIfAsked) {
  for (const int scans : {1, 2}) {
    LidarPointsNodeConfig config;
    config.occluder_scans = scans;
    config.cloud.outlier_radius_m = 0.0;
    LidarPointsWorker worker(config);
    LidarJob job;
    job.map_from_sensor = {{1.0, Eigen::Isometry3d::Identity()}};
    job.labels = cv::Mat(60, 80, CV_16UC1, cv::Scalar(1));
    job.camera.camera = {80, 60, 50.0, 50.0, 39.5, 29.5};
    job.scan = {1.0, {{0.0F, 0.0F, 5.0F}}, {}};  // the camera's frame is the sensor's
    LidarJobReport report;
    EXPECT_EQ(worker.work(job, &report).at(0).points.at(0).label, 1);
    job.scan.points = {{0.0F, 0.0F, 20.0F}};
    EXPECT_EQ(worker.work(job, &report).at(0).points.at(0).label, scans == 1 ? 1 : kUnlabelled);
    worker.clear();
    EXPECT_EQ(worker.work(job, &report).at(0).points.at(0).label, 1);
    EXPECT_EQ(report.labelled, scans == 1 ? 3U : 2U);
  }
}

}  // namespace
}  // namespace facet_mapping
