// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_harness.h"

#include "corridor.h"
#include <cv_bridge/cv_bridge.h>
#include <ros/callback_queue.h>
#include <tf2_eigen/tf2_eigen.h>

#include "facet_mapping/ros/cloud_conversions.h"

namespace facet_mapping::test {
namespace {

constexpr std::uint32_t kQueueSize = 100;
constexpr char kCameraFrame[] = "camera";
constexpr char kSensorFrame[] = "sensor";

geometry_msgs::TransformStamped pose_message(const Eigen::Isometry3d& map_from_child,
                                             const std::string& child,
                                             const ros::Time& stamp) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(map_from_child);
  message.header.frame_id = "map";
  message.header.stamp = stamp;
  message.child_frame_id = child;
  return message;
}

sensor_msgs::CameraInfo info_message(const std_msgs::Header& header, double baseline_m) {
  const PinholeCamera camera = corridor_camera();
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.P = {
      camera.fx, 0, camera.cx, -camera.fx * baseline_m, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

sensor_msgs::Image image_message(const std_msgs::Header& header, const cv::Mat& pixels) {
  return *cv_bridge::CvImage(header, "mono8", pixels).toImageMsg();
}

}  // namespace

bool wait_until(const std::function<bool()>& done, double timeout_s) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout_s);
  while (!done() && ros::ok() && ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
  }
  return done();
}

DiagnosticsEar::DiagnosticsEar() {
  subscriber_ = ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", kQueueSize, [this](const diagnostic_msgs::DiagnosticArrayConstPtr& array) {
        for (const diagnostic_msgs::DiagnosticStatus& status : array->status) {
          const std::string node = status.name.substr(0, status.name.find(':'));
          ++messages_[node];
          for (const diagnostic_msgs::KeyValue& entry : status.values) {
            values_[node][entry.key] = entry.value;
          }
        }
      });
}

std::uint64_t DiagnosticsEar::value(const std::string& node, const std::string& key) const {
  const auto found = values_.find(node);
  if (found == values_.end() || found->second.count(key) == 0) {
    return 0;
  }
  return static_cast<std::uint64_t>(std::stod(found->second.at(key)));
}

std::string DiagnosticsEar::text(const std::string& node, const std::string& key) const {
  const auto found = values_.find(node);
  return found == values_.end() || found->second.count(key) == 0 ? "" : found->second.at(key);
}

bool DiagnosticsEar::hears(const std::string& node) {
  const std::uint64_t before = messages_[node];
  return wait_until([&] { return messages_[node] > before; });
}

bool DiagnosticsEar::rises(const std::string& node,
                           const std::string& key,
                           const std::function<void()>& action) {
  const std::uint64_t before = value(node, key);
  action();
  return wait_until([&] { return value(node, key) > before; }) && hears(node);
}

CorridorCar::CorridorCar() {
  ros::NodeHandle nh;
  left_ = nh.advertise<sensor_msgs::Image>("left/image_rect", kQueueSize);
  right_ = nh.advertise<sensor_msgs::Image>("right/image_rect", kQueueSize);
  left_info_ = nh.advertise<sensor_msgs::CameraInfo>("left/camera_info", kQueueSize);
  right_info_ = nh.advertise<sensor_msgs::CameraInfo>("right/camera_info", kQueueSize);
  segmentation_ = nh.advertise<sensor_msgs::Image>("segmentation", kQueueSize);
}

bool CorridorCar::is_connected() const {
  // The left camera and its segmentation go to stereo_points and to the refiner.
  for (const ros::Publisher* p : {&left_, &left_info_, &segmentation_}) {
    if (p->getNumSubscribers() < 2) {
      return false;
    }
  }
  return right_.getNumSubscribers() > 0 && right_info_.getNumSubscribers() > 0;
}

CorridorCar::Frame CorridorCar::look(double x_m, const ros::Time& stamp) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = kCameraFrame;
  Frame frame;
  frame.left = image_message(header, draw_gray(map_from_left(x_m)));
  frame.right = image_message(header, draw_gray(map_from_right(x_m)));
  frame.left_info = info_message(header, 0.0);
  frame.right_info = info_message(header, kBaselineM);
  frame.segmentation = image_message(header, draw_labels(map_from_left(x_m)));
  return frame;
}

void CorridorCar::publish_pose(double x_m, const ros::Time& stamp) {
  tf_.sendTransform(pose_message(map_from_left(x_m), kCameraFrame, stamp));
}

void CorridorCar::publish_images(const Frame& frame, bool with_segmentation) {
  left_info_.publish(frame.left_info);
  right_info_.publish(frame.right_info);
  left_.publish(frame.left);
  right_.publish(frame.right);
  if (with_segmentation) {
    segmentation_.publish(frame.segmentation);
  }
}

void CorridorCar::drive_to(double x_m, const ros::Time& stamp) {
  publish_pose(x_m, stamp);
  publish_images(look(x_m, stamp));
}

sensor_msgs::PointCloud2 corridor_cloud(double x_m, const ros::Time& stamp) {
  std::vector<LabeledPoint> points;
  const Eigen::Isometry3d sensor_from_map = map_from_left(x_m).inverse(Eigen::Isometry);
  const auto add = [&](const Eigen::Vector3d& point, Label label) {
    points.push_back({(sensor_from_map * point).cast<float>(), label, 0.02F});
  };
  for (double y = -3.5; y <= 3.5; y += 0.5) {
    for (double x = x_m + 2.0; x < kEndM; x += 0.5) {
      add({x, y, 0.01 * std::sin(7.0 * x + 3.0 * y)}, kRoad);
    }
    for (double z = 0.5; z <= 4.0; z += 0.5) {
      add({kEndM + 0.01 * std::sin(5.0 * y + 9.0 * z), y, z}, kBuilding);
    }
  }
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = kSensorFrame;
  return cloud_from_points(points, header);
}

void publish_sensor_pose(tf2_ros::TransformBroadcaster* tf, double x_m, const ros::Time& stamp) {
  tf->sendTransform(pose_message(map_from_left(x_m), kSensorFrame, stamp));
}

MeshEar::MeshEar(const std::string& topic) {
  subscriber_ = ros::NodeHandle().subscribe<LabeledMesh>(
      topic, kQueueSize, [this](const LabeledMeshConstPtr& message) {
        ++messages_;
        full_messages_ += message->full;
        missed_ = missed_ || receiver_.apply(*message) == MeshReceiver::Result::kGap;
      });
}

}  // namespace facet_mapping::test
