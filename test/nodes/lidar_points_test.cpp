// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A scanner that drives down the corridor: flat walls, right classes, and what may be wrong.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "corridor.h"
#include "node_harness.h"
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>

#include "facet_mapping/ros/cloud_conversions.h"
#include "facet_mapping/ros/lidar_points_node.h"

namespace facet_mapping::test {
namespace {

constexpr double kSpeed = 8.0;  // metres per second
constexpr double kScanS = 0.1;

std::string node_name() {
  return ros::this_node::getName().substr(1) + "/lidar_points";
}

/// The scanner looks forward, 0.4 m above the camera.
Eigen::Isometry3d map_from_lidar(double x_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x_m, 0.0, kCameraHeightM + 0.4);
  return pose;
}

/// Where the car is; every test starts later.
class Drive {
 public:
  explicit Drive(double start_s) : start_s_(start_s) {}
  double x_m(double stamp_s) const { return kSpeed * (stamp_s - start_s_); }

  void send_tf(double first_s, double last_s) {
    std::vector<geometry_msgs::TransformStamped> poses;
    for (double stamp = first_s; stamp < last_s + 0.005; stamp += 0.01) {
      add(map_from_lidar(x_m(stamp)), "lidar", stamp, &poses);
      add(map_from_left(x_m(stamp)), "camera", stamp, &poses);
    }
    tf_.sendTransform(poses);
  }

 private:
  static void add(const Eigen::Isometry3d& map_from_child,
                  const std::string& child,
                  double stamp,
                  std::vector<geometry_msgs::TransformStamped>* poses) {
    geometry_msgs::TransformStamped message = tf2::eigenToTransform(map_from_child);
    message.header.frame_id = "map";
    message.header.stamp = ros::Time(stamp);
    message.child_frame_id = child;
    poses->push_back(message);
  }

  double start_s_;
  tf2_ros::TransformBroadcaster tf_;
};

/// One turn from `stamp` on, or a part of it: road, end wall and what lies behind, each point as
/// seen at its own time.
sensor_msgs::PointCloud2 scan(const Drive& drive, double stamp, double length_s = kScanS) {
  std::vector<Eigen::Vector3d> world;
  for (double y = -3.5; y <= 3.5; y += 0.25) {
    for (double x = -6.0; x < kEndM; x += 0.5) {
      world.emplace_back(x, y, 0.0);
    }
    for (double z = 0.25; z <= 4.0; z += 0.25) {
      world.emplace_back(kEndM, y, z);
    }
  }
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "lidar";
  cloud.header.stamp = ros::Time(stamp);
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  using sensor_msgs::PointField;
  modifier.setPointCloud2Fields(4,
                                "x",
                                1,
                                PointField::FLOAT32,
                                "y",
                                1,
                                PointField::FLOAT32,
                                "z",
                                1,
                                PointField::FLOAT32,
                                "t",
                                1,
                                PointField::UINT32);
  modifier.resize(world.size());
  sensor_msgs::PointCloud2Iterator<float> position(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint32_t> time(cloud, "t");
  for (std::size_t i = 0; i < world.size(); ++i, ++position, ++time) {
    // Neighbours are measured at different times, so that smear shows on every surface.
    const double offset_s = length_s * static_cast<double>((i * 37) % world.size()) /
                            static_cast<double>(world.size() - 1);
    const Eigen::Vector3d seen =
        map_from_lidar(drive.x_m(stamp + offset_s)).inverse(Eigen::Isometry) * world[i];
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = static_cast<float>(seen[axis]);
    }
    *time = static_cast<std::uint32_t>(std::lround(offset_s * 1e9));
  }
  return cloud;
}

class LidarPointsNodeTest : public testing::Test {
 protected:
  void SetUp() override {
    ros::NodeHandle nh;
    cloud_pub_ = nh.advertise<sensor_msgs::PointCloud2>("point_cloud", 100);
    info_pub_ = nh.advertise<sensor_msgs::CameraInfo>("camera_info", 100);
    labels_pub_ = nh.advertise<sensor_msgs::Image>("segmentation", 100);
    ear_ = nh.subscribe<sensor_msgs::PointCloud2>(
        "points", 100, [this](const sensor_msgs::PointCloud2ConstPtr& m) { heard_.push_back(m); });
    ros::param::del("~lidar_points");
    set("diagnostic_period", 0.1);
    set("tf_timeout_s", 1.0);
    set("segmentation_timeout_s", 0.5);
    start_s_ += 100.0;
    drive_ = std::make_unique<Drive>(start_s_);
  }

  template <typename T>
  static void set(const std::string& name, const T& value) {
    ros::param::set("~lidar_points/" + name, value);
  }

  void start(bool with_segmentation = true) {
    set("use_segmentation", with_segmentation);
    node_ = std::make_unique<LidarPointsNode>(ros::NodeHandle(), ros::NodeHandle("~lidar_points"));
    ASSERT_TRUE(wait_until([&] {
      return cloud_pub_.getNumSubscribers() > 0 && ear_.getNumPublishers() > 0 &&
             (!with_segmentation ||
              (info_pub_.getNumSubscribers() > 0 && labels_pub_.getNumSubscribers() > 0));
    }));
    wait_until([] { return false; }, 0.3);  // the node must know of the ear, too
  }

  void publish_labels(double stamp, int factor = 1) {
    CorridorCar::Frame frame = CorridorCar::look(drive_->x_m(stamp), ros::Time(stamp));
    frame.segmentation.height /= static_cast<unsigned>(factor);
    frame.segmentation.data.resize(frame.segmentation.data.size() /
                                   static_cast<std::size_t>(factor));
    info_pub_.publish(frame.left_info);
    wait_until([] { return false; }, 0.1);
    labels_pub_.publish(frame.segmentation);
  }

  /// Poses, labels 30 ms after the scan's stamp, and the scan.
  void drive_by(double stamp) {
    drive_->send_tf(stamp - 0.2, stamp + 0.3);
    publish_labels(stamp + 0.03);
    cloud_pub_.publish(scan(*drive_, stamp));
  }

  bool hears(std::size_t clouds) {
    return wait_until([&] { return heard_.size() >= clouds; });
  }

  bool complains(const std::string& reason, const std::function<void()>& action) {
    return diagnostics_.rises(node_name(), "problem: " + reason, action);
  }

  /// All points lie on the corridor, from the pose at the cloud's own stamp.
  void expect_flat(const sensor_msgs::PointCloud2& cloud) const {
    EXPECT_EQ(cloud.header.frame_id, "lidar");
    const Eigen::Isometry3d pose = map_from_lidar(drive_->x_m(cloud.header.stamp.toSec()));
    for (const LabeledPoint& point : points_from_cloud(cloud)) {
      EXPECT_LT(distance_to_corridor(pose * point.position.cast<double>()), 0.01);
    }
  }

  static double start_s_;
  std::unique_ptr<Drive> drive_;
  ros::Publisher cloud_pub_;
  ros::Publisher info_pub_;
  ros::Publisher labels_pub_;
  ros::Subscriber ear_;
  std::vector<sensor_msgs::PointCloud2ConstPtr> heard_;
  DiagnosticsEar diagnostics_;
  std::unique_ptr<LidarPointsNode> node_;
};

double LidarPointsNodeTest::start_s_ = 1000.0;

TEST_F(LidarPointsNodeTest, MovingScanIsFlatAndLabelled) {
  start();
  const double stamp = start_s_ + 0.5;
  drive_by(stamp);
  ASSERT_TRUE(hears(1));
  const sensor_msgs::PointCloud2& cloud = *heard_.front();
  EXPECT_EQ(cloud.header.stamp, ros::Time(stamp));
  expect_flat(cloud);
  const Eigen::Isometry3d pose = map_from_lidar(drive_->x_m(stamp));
  const Eigen::Isometry3d camera = map_from_left(drive_->x_m(stamp + 0.03));
  std::size_t labelled = 0;
  for (const LabeledPoint& point : points_from_cloud(cloud)) {
    const Eigen::Vector3d world = pose * point.position.cast<double>();
    if (point.label != kUnlabelled) {
      ++labelled;
      EXPECT_GT((camera.inverse(Eigen::Isometry) * world).z(), 0.0);
      // Half a pixel of the image is 3 cm at the far end.
      if (std::abs(world.z()) > 0.1 || kEndM - world.x() > 0.6) {
        EXPECT_EQ(point.label, world.z() > 0.1 ? kBuilding : kRoad) << world.transpose();
      }
    }
    EXPECT_FLOAT_EQ(point.sigma, 0.03F);
  }
  EXPECT_GT(labelled, 400U);
  EXPECT_LT(labelled, points_from_cloud(cloud).size() - 200) << "behind the camera";
}

TEST_F(LidarPointsNodeTest, LongWayIsCutIntoParts) {
  set("split_m", 0.3);
  start();
  drive_by(start_s_ + 0.5);
  ASSERT_TRUE(hears(3));
  for (std::size_t k = 0; k < 3; ++k) {
    expect_flat(*heard_[k]);
    EXPECT_GE((heard_[k]->header.stamp - ros::Time(start_s_ + 0.5)).toSec(), 0.03 * k);
  }
}

TEST_F(LidarPointsNodeTest, PacketsAreGathered) {
  set("frame_s", 0.1);
  start(false);
  drive_->send_tf(start_s_, start_s_ + 1.0);
  for (int i = 0; i < 10; ++i) {
    cloud_pub_.publish(scan(*drive_, start_s_ + 0.5 + 0.01 * i, 0.01));
    wait_until([] { return false; }, 0.02);
  }
  ASSERT_TRUE(hears(1));
  EXPECT_EQ(diagnostics_.hears(node_name()), true);
  EXPECT_EQ(heard_.size(), 1U);
  expect_flat(*heard_.front());
  EXPECT_NEAR(heard_.front()->header.stamp.toSec(), start_s_ + 0.54, 0.02);
}

TEST_F(LidarPointsNodeTest, CleansWithoutTfAndSegmentation) {
  set("time_field", "none");
  start(false);
  cloud_pub_.publish(scan(*drive_, start_s_ + 0.5));
  ASSERT_TRUE(hears(1));
  const auto points = points_from_cloud(*heard_.front());
  EXPECT_GT(points.size(), 500U);
  for (const LabeledPoint& point : points) {
    EXPECT_EQ(point.label, kUnlabelled);
  }
}

TEST_F(LidarPointsNodeTest, WithoutSegmentationItComplainsAndGoesOn) {
  start();
  drive_->send_tf(start_s_, start_s_ + 2.0);
  publish_labels(start_s_ + 1.5);  // too far away in time
  EXPECT_TRUE(
      complains("no segmentation", [&] { cloud_pub_.publish(scan(*drive_, start_s_ + 0.5)); }));
  ASSERT_TRUE(hears(1));
  expect_flat(*heard_.front());
  EXPECT_TRUE(complains("segmentation of another size", [&] {
    publish_labels(start_s_ + 1.7, 2);
    cloud_pub_.publish(scan(*drive_, start_s_ + 1.7));
  }));
  ASSERT_TRUE(hears(2));
  EXPECT_EQ(points_from_cloud(*heard_[1]).front().label, kUnlabelled);
}

TEST_F(LidarPointsNodeTest, LateTfIsWaitedForAndMissingTfIsSaid) {
  start();
  publish_labels(start_s_ + 0.5);
  cloud_pub_.publish(scan(*drive_, start_s_ + 0.5));
  wait_until([] { return false; }, 0.3);
  EXPECT_TRUE(heard_.empty());
  drive_->send_tf(start_s_ + 0.3, start_s_ + 0.8);
  ASSERT_TRUE(hears(1));
  expect_flat(*heard_.front());
  EXPECT_TRUE(complains("no transform", [&] {
    publish_labels(start_s_ + 0.75);
    cloud_pub_.publish(scan(*drive_, start_s_ + 0.75));  // tf ends in its middle
  }));
  EXPECT_TRUE(complains("unusable poses", [&] {  // tf begins in its middle
    sensor_msgs::PointCloud2 cloud = scan(*drive_, start_s_ + 0.25);
    cloud.header.stamp += ros::Duration(kScanS);
    for (sensor_msgs::PointCloud2Iterator<std::uint32_t> t(cloud, "t"); t != t.end(); ++t) {
      *t = 0U - (100000000U - *t);  // as an INT32 below: before the stamp
    }
    cloud.fields[3].datatype = sensor_msgs::PointField::INT32;
    publish_labels(start_s_ + 0.35);
    cloud_pub_.publish(cloud);
  }));
  EXPECT_EQ(heard_.size(), 1U);
}

TEST_F(LidarPointsNodeTest, UnusableCloudsAreSaid) {
  start(false);
  drive_->send_tf(start_s_, start_s_ + 1.0);
  const double stamp = start_s_ + 0.5;
  const auto expect_problem = [&](const std::string& reason, const auto& change) {
    EXPECT_TRUE(complains(reason, [&] {
      sensor_msgs::PointCloud2 cloud = scan(*drive_, stamp);
      change(cloud);
      cloud_pub_.publish(cloud);
    })) << reason;
  };
  expect_problem("unusable cloud", [](auto& cloud) { cloud.fields[0].name = "range"; });
  expect_problem("unusable cloud", [](auto& cloud) { cloud.data.resize(7); });
  expect_problem("unusable cloud", [](auto& cloud) {  // a clock of its own
    for (sensor_msgs::PointCloud2Iterator<std::uint32_t> t(cloud, "t"); t != t.end(); ++t) {
      *t += 3000000000U;
    }
  });
  expect_problem("point times all alike", [](auto& cloud) {
    for (sensor_msgs::PointCloud2Iterator<std::uint32_t> t(cloud, "t"); t != t.end(); ++t) {
      *t = 0;
    }
  });
  expect_problem("empty cloud", [](auto& cloud) {
    cloud.width = 0;
    cloud.row_step = 0;
    cloud.data.clear();
  });
  expect_problem("empty cloud", [](auto& cloud) {
    for (sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"); x != x.end(); ++x) {
      *x = std::nanf("");
    }
  });
  expect_problem("no stamp", [](auto& cloud) { cloud.header.stamp = ros::Time(); });
  expect_problem("no frame_id", [](auto& cloud) { cloud.header.frame_id = ""; });
  expect_problem("time jumped back",
                 [](auto& cloud) { cloud.header.stamp -= ros::Duration(400.0); });
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "lidar_points_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
