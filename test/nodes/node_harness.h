// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of the nodes share: a car that publishes what it sees in the corridor, and an ear
// on /diagnostics.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/transform_broadcaster.h>

#include "facet_mapping/ros/mesh_receiver.h"

namespace facet_mapping::test {

/// Serves callbacks until `done` or for at most `timeout_s`; returns done().
bool wait_until(const std::function<bool()>& done, double timeout_s = 20.0);

/// The counters of every node.
class DiagnosticsEar {
 public:
  DiagnosticsEar();
  /// The value of a key such as "problem: no transform"; 0 before it appears.
  std::uint64_t value(const std::string& node, const std::string& key) const;
  /// The value as it was written; empty before it appears.
  std::string text(const std::string& node, const std::string& key) const;
  /// True if the node has published after now.
  bool hears(const std::string& node);
  /// True if the counter rises above what it is now because of `action`, and the node lives on.
  bool rises(const std::string& node, const std::string& key, const std::function<void()>& action);

 private:
  ros::Subscriber subscriber_;
  std::map<std::string, std::map<std::string, std::string>> values_;
  std::map<std::string, std::uint64_t> messages_;
};

/// Publishes to stereo_points and refiner (left/..., right/..., segmentation) and tf.
class CorridorCar {
 public:
  CorridorCar();
  /// True once all topics have subscribers.
  bool is_connected() const;

  struct Frame {
    sensor_msgs::Image left;
    sensor_msgs::Image right;
    sensor_msgs::CameraInfo left_info;
    sensor_msgs::CameraInfo right_info;
    sensor_msgs::Image segmentation;
  };
  /// What the car sees `x_m` metres down the corridor.
  static Frame look(double x_m, const ros::Time& stamp);

  void publish_pose(double x_m, const ros::Time& stamp);
  void publish_images(const Frame& frame, bool with_segmentation = true);
  /// Pose, images and segmentation at once.
  void drive_to(double x_m, const ros::Time& stamp);

 private:
  ros::Publisher left_;
  ros::Publisher right_;
  ros::Publisher left_info_;
  ros::Publisher right_info_;
  ros::Publisher segmentation_;
  tf2_ros::TransformBroadcaster tf_;
};

/// A cloud of the corridor's road and end wall as a sensor at `x_m` sees it, in frame "sensor", for
/// tests of the mapper alone.
sensor_msgs::PointCloud2 corridor_cloud(double x_m, const ros::Time& stamp);
/// Publishes the pose of "sensor".
void publish_sensor_pose(tf2_ros::TransformBroadcaster* tf, double x_m, const ros::Time& stamp);

/// Keeps the mesh of a topic.
class MeshEar {
 public:
  explicit MeshEar(const std::string& topic);
  const MeshReceiver& receiver() const { return receiver_; }
  std::size_t messages() const { return messages_; }
  std::size_t full_messages() const { return full_messages_; }
  bool missed_something() const { return missed_; }
  bool has_facets() const { return receiver_.has_mesh() && !receiver_.mesh().empty(); }

 private:
  ros::Subscriber subscriber_;
  MeshReceiver receiver_;
  std::size_t messages_ = 0;
  std::size_t full_messages_ = 0;
  bool missed_ = false;
};

}  // namespace facet_mapping::test
