// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Corrected poses move the mesh; what cannot be applied is said, and the rest is applied.
#include <cmath>
#include <limits>

#include "corridor.h"
#include "node_harness.h"
#include <geometry_msgs/PoseArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "facet_mapping/Reset.h"
#include "facet_mapping/ros/corrected_poses.h"

namespace facet_mapping::test {
namespace {

constexpr char kMapper[] = "mapper";

/// Where the sensor is on the car: the corrected poses are those of base_link.
Eigen::Isometry3d base_from_sensor() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.7, -0.2, 1.1);
  pose.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  return pose;
}

geometry_msgs::TransformStamped fixed(const Eigen::Isometry3d& parent_from_child,
                                      const std::string& parent,
                                      const std::string& child) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(parent_from_child);
  message.header.frame_id = parent;
  message.header.stamp = ros::Time::now();
  message.child_frame_id = child;
  return message;
}

Eigen::Isometry3d map_from_odom() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(5.0, -3.0, 2.0);
  pose.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  return pose;
}

double mean_road_height(const TriangleMesh& mesh) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (mesh.labels[f] == kRoad) {
      sum += mesh.vertices[mesh.triangles[f][0]].z();
      count += 1.0;
    }
  }
  return sum / count;
}

class MovedKeyframesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ros::NodeHandle nh;
    cloud_pub_ = nh.advertise<sensor_msgs::PointCloud2>("cloud", 10);
    path_pub_ = nh.advertise<nav_msgs::Path>("keyframe_poses", 10);
    array_pub_ = nh.advertise<geometry_msgs::PoseArray>("keyframe_pose_array", 10);
    keyframes_sub_ = nh.subscribe<nav_msgs::Path>(
        "mapper/keyframes", 10, [this](const nav_msgs::PathConstPtr& path) { keyframes_ = *path; });
    static_tf_.sendTransform({fixed(base_from_sensor().inverse(), "sensor", "base_link"),
                              fixed(map_from_odom(), "map", "odom")});
    ASSERT_TRUE(wait_until([this] {
      return cloud_pub_.getNumSubscribers() > 0 && path_pub_.getNumSubscribers() > 0 &&
             array_pub_.getNumSubscribers() > 0;
    }));
    Reset reset;
    ASSERT_TRUE(ros::service::call("mapper/reset", reset));
    ASSERT_TRUE(wait_until([this] { return ear_.messages() > 0 && !ear_.has_facets(); }));
    ASSERT_TRUE(diagnostics_.hears(kMapper));  // what the counters were before
    drive();
  }

  void drive() {
    for (int k = 0; k < 3; ++k) {
      const ros::Time now = ros::Time::now();
      publish_sensor_pose(&tf_, k, now);
      cloud_pub_.publish(corridor_cloud(k, now));
      ASSERT_TRUE(
          wait_until([&] { return keyframes_.poses.size() == static_cast<std::size_t>(k) + 1; }));
    }
    ASSERT_TRUE(wait_until([this] { return ear_.has_facets(); }));
    ASSERT_NEAR(mean_road_height(ear_.receiver().mesh()), 0.0, 0.05);
  }

  /// All keyframes as poses of base_link, `lift_m` higher.
  nav_msgs::Path lifted(double lift_m) const {
    nav_msgs::Path path = keyframes_;
    for (geometry_msgs::PoseStamped& pose : path.poses) {
      Eigen::Isometry3d map_from_base = pose_from_message(pose.pose) * base_from_sensor().inverse();
      map_from_base.translation().z() += lift_m;
      pose.pose = tf2::toMsg(map_from_base);
    }
    return path;
  }

  bool road_rises_to(double height_m) {
    return wait_until(
        [&] { return std::abs(mean_road_height(ear_.receiver().mesh()) - height_m) < 0.05; });
  }

  ros::Publisher cloud_pub_;
  ros::Publisher path_pub_;
  ros::Publisher array_pub_;
  ros::Subscriber keyframes_sub_;
  nav_msgs::Path keyframes_;
  tf2_ros::TransformBroadcaster tf_;
  tf2_ros::StaticTransformBroadcaster static_tf_;
  MeshEar ear_{"mapper/mesh"};
  DiagnosticsEar diagnostics_;
};

TEST_F(MovedKeyframesTest, KeyframesAreOfferedWithStampAndId) {
  ASSERT_EQ(keyframes_.poses.size(), 3U);
  EXPECT_EQ(keyframes_.header.frame_id, "map");
  for (std::size_t k = 0; k < 3; ++k) {
    const geometry_msgs::PoseStamped& pose = keyframes_.poses[k];
    EXPECT_EQ(pose.header.seq, k);
    EXPECT_TRUE(pose_from_message(pose.pose).isApprox(map_from_left(static_cast<double>(k)), 1e-6));
  }
  EXPECT_LT(keyframes_.poses[0].header.stamp, keyframes_.poses[1].header.stamp);
}

TEST_F(MovedKeyframesTest, AMovedPathMovesTheMesh) {
  path_pub_.publish(lifted(0.8));
  EXPECT_TRUE(road_rises_to(0.8));
  EXPECT_TRUE(wait_until(
      [&] { return std::abs(keyframes_.poses[0].pose.position.z - kCameraHeightM - 0.8) < 1e-6; }));
  // In another frame, and within the tolerance of the stamps.
  nav_msgs::Path in_odom = lifted(0.4);  // on top of the 0.8
  in_odom.header.frame_id = "odom";
  for (geometry_msgs::PoseStamped& pose : in_odom.poses) {
    pose.header.frame_id.clear();
    pose.header.stamp += ros::Duration(0.0005);
    pose.pose = tf2::toMsg(map_from_odom().inverse() * pose_from_message(pose.pose));
  }
  path_pub_.publish(in_odom);
  EXPECT_TRUE(road_rises_to(1.2));
}

TEST_F(MovedKeyframesTest, AnArrayMovesByIdAndOnePoseTooManyIsSaid) {
  geometry_msgs::PoseArray array;
  array.header.frame_id = "map";
  for (const geometry_msgs::PoseStamped& pose : lifted(-0.5).poses) {
    array.poses.push_back(pose.pose);
  }
  array.poses.push_back(array.poses.back());
  EXPECT_TRUE(diagnostics_.rises(
      kMapper, "problem: corrected poses of no keyframe", [&] { array_pub_.publish(array); }));
  EXPECT_TRUE(road_rises_to(-0.5));
}

TEST_F(MovedKeyframesTest, WhatCannotBeAppliedIsSaidAndTheRestApplied) {
  nav_msgs::Path path = lifted(0.3);
  geometry_msgs::PoseStamped stranger = path.poses[0];
  stranger.header.stamp -= ros::Duration(10.0);  // before the drive
  path.poses.push_back(stranger);
  EXPECT_TRUE(diagnostics_.rises(
      kMapper, "problem: corrected poses of no keyframe", [&] { path_pub_.publish(path); }));
  EXPECT_TRUE(road_rises_to(0.3));
  path = lifted(0.3);
  geometry_msgs::PoseStamped broken = path.poses[0];
  broken.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  path.poses.push_back(broken);
  broken = path.poses[0];
  broken.pose.orientation.w += 1.0;
  path.poses.push_back(broken);
  EXPECT_TRUE(diagnostics_.rises(
      kMapper, "problem: corrected poses not rigid", [&] { path_pub_.publish(path); }));
  EXPECT_TRUE(road_rises_to(0.6));
  path.header.frame_id = "nowhere";
  path.poses[0].header.frame_id = "nowhere";
  EXPECT_TRUE(diagnostics_.rises(
      kMapper, "problem: corrected poses in an unknown frame", [&] { path_pub_.publish(path); }));
}

TEST_F(MovedKeyframesTest, PosesThatChangeNothingCostNothing) {
  const std::uint32_t sequence = ear_.receiver().sequence();
  EXPECT_TRUE(diagnostics_.rises(
      kMapper, "corrected poses that change nothing", [&] { path_pub_.publish(lifted(0.0005)); }));
  EXPECT_EQ(ear_.receiver().sequence(), sequence);
  EXPECT_EQ(diagnostics_.value(kMapper, "problem: corrected poses of frozen keyframes"), 0U);
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "moved_keyframes_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
