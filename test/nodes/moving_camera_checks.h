// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What holds for every node that makes points of one moving camera.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "corridor.h"
#include "node_harness.h"
#include <gtest/gtest.h>

#include "facet_mapping/ros/cloud_conversions.h"

namespace facet_mapping::test {

/// A car with one camera, and the clouds that come out. The tests run in their order: stamps go on.
class MovingCameraTest : public testing::Test {
 protected:
  static void start(const std::string& node) {
    node_ = node;
    diagnostics_ = std::make_unique<DiagnosticsEar>();
    car_ = std::make_unique<CorridorCar>();
    clouds_ = std::make_unique<std::vector<sensor_msgs::PointCloud2>>();
    const boost::function<void(const sensor_msgs::PointCloud2ConstPtr&)> keep =
        [](const sensor_msgs::PointCloud2ConstPtr& cloud) { clouds_->push_back(*cloud); };
    ear_ = ros::NodeHandle().subscribe<sensor_msgs::PointCloud2>("points", 100, keep);
  }
  static void TearDownTestSuite() {
    ear_.shutdown();
    car_.reset();
    diagnostics_.reset();
  }

  static ros::Time stamp() { return stamp_ += ros::Duration(0.1); }

  static std::uint64_t value(const std::string& key) { return diagnostics_->value(node_, key); }

  /// Publishes from one place until the node has received something; the stamp of the last image.
  static bool is_running() {
    const auto heard = [] {
      drive(0.0, 1, 0.0);
      wait_until([] { return false; }, 0.2);
      return value("images") > 0;
    };
    return wait_until(heard, 60.0);
  }

  static void drive(double from_m, int frames, double step_m) {
    for (int k = 0; k < frames; ++k) {
      const ros::Time now = stamp();
      where_[now] = from_m + k * step_m;
      car_->drive_to(from_m + k * step_m, now);
      wait_until([] { return false; }, 0.1);
    }
  }

  /// Distances from the true surfaces of all points that a class was given, metres, sorted.
  static std::vector<double> errors() {
    std::vector<double> errors;
    for (const sensor_msgs::PointCloud2& cloud : *clouds_) {
      for (const LabeledPoint& point : points_from_cloud(cloud)) {
        if (point.label != kUnlabelled) {
          errors.push_back(distance_to_corridor(map_from_left(where_.at(cloud.header.stamp)) *
                                                point.position.cast<double>()));
        }
      }
    }
    std::sort(errors.begin(), errors.end());
    return errors;
  }

  static void expect_points_of_a_drive() {
    ASSERT_TRUE(is_running());
    clouds_->clear();
    drive(0.4, 10, 0.4);
    // The last images' points wait for views that never come, until flush_after_s.
    ASSERT_TRUE(wait_until([] {
      return !clouds_->empty() && clouds_->back().header.stamp == where_.rbegin()->first;
    })) << clouds_->size()
        << " clouds";
    for (std::size_t k = 1; k < clouds_->size(); ++k) {
      EXPECT_LT((*clouds_)[k - 1].header.stamp, (*clouds_)[k].header.stamp);
      EXPECT_EQ((*clouds_)[k].header.frame_id, "camera");
    }
    const std::vector<double> distances = errors();
    ASSERT_GT(distances.size(), 1000U);
    EXPECT_LT(distances[distances.size() / 2], 0.05);
    EXPECT_LT(distances[distances.size() * 9 / 10], 0.3);
  }

  static void expect_that_a_standing_camera_is_said() {
    clouds_->clear();
    drive(8.0, 3, 0.0);
    EXPECT_TRUE(diagnostics_->rises(node_, "images without parallax", [] { drive(8.0, 3, 0.0); }));
    wait_until([] { return false; }, 2.0);  // longer than flush_after_s
    EXPECT_TRUE(errors().empty());
  }

  static void expect_that_a_jump_in_time_is_survived() {
    stamp_ = ros::Time(500.0);
    EXPECT_TRUE(
        diagnostics_->rises(node_, "problem: time jumped back", [] { drive(0.0, 1, 0.0); }));
    clouds_->clear();
    drive(0.0, 8, 0.4);
    EXPECT_TRUE(wait_until([] { return !clouds_->empty(); }));
  }

  static void expect_that_bad_images_are_refused() {
    EXPECT_TRUE(diagnostics_->rises(node_, "problem: unusable image", [] {
      const ros::Time now = stamp();
      car_->publish_pose(1.0, now);
      CorridorCar::Frame frame = CorridorCar::look(1.0, now);
      frame.left.data.resize(100);
      car_->publish_images(frame);
    }));
    EXPECT_TRUE(diagnostics_->rises(node_, "problem: no transform", [] {
      CorridorCar::Frame frame = CorridorCar::look(1.0, stamp());
      frame.left.header.frame_id = "frame_without_tf";
      car_->publish_images(frame);
    }));
  }

  inline static std::string node_;
  inline static ros::Time stamp_{1000.0};
  inline static std::map<ros::Time, double> where_;
  inline static std::unique_ptr<DiagnosticsEar> diagnostics_;
  inline static std::unique_ptr<CorridorCar> car_;
  inline static std::unique_ptr<std::vector<sensor_msgs::PointCloud2>> clouds_;
  inline static ros::Subscriber ear_;
};

}  // namespace facet_mapping::test
