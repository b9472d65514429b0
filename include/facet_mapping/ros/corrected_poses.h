// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corrected poses of keyframes, as a loop closure publishes them, on their way to the map.
#pragma once

#include <functional>
#include <map>
#include <string>

#include <geometry_msgs/PoseArray.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>

#include "facet_mapping/mapping/pose_corrector.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

/// Subscribes `keyframe_poses` (nav_msgs/Path: the stamps name the keyframes) and
/// `keyframe_pose_array` (geometry_msgs/PoseArray: pose k is that of keyframe k, counted from 0 in
/// the order of arrival since the last reset). Callbacks in the node's thread.
class CorrectedPoses {
 public:
  /// False if the corrections are lost, since too much waits.
  using Push = std::function<bool(PoseCorrections)>;

  /// `corrected_frame`: the frame whose poses come, rigidly attached to the sensors; "" if they are
  /// the sensors' own.
  CorrectedPoses(ros::NodeHandle nh,
                 const std::string& map_frame,
                 const std::string& corrected_frame,
                 const tf2_ros::Buffer* buffer,
                 NodeDiagnostics* diagnostics,
                 Push push);

  /// The frame in which a sensor's points come.
  void note_sensor(const std::string& sensor, const std::string& frame_id);
  /// Complains about what could not be applied. In any thread.
  void report(const CorrectionReport& report);

 private:
  void receive_path(const nav_msgs::Path& path);
  void receive_array(const geometry_msgs::PoseArray& array);
  void hand_on(PoseCorrections corrections);
  bool find_map_from(const std::string& frame_id, Eigen::Isometry3d* map_from_frame);

  std::string map_frame_;
  std::string corrected_frame_;
  const tf2_ros::Buffer* buffer_;
  NodeDiagnostics* diagnostics_;
  Push push_;
  std::map<std::string, std::string> frame_of_sensor_;
  ros::Subscriber path_subscriber_;
  ros::Subscriber array_subscriber_;
};

/// Not rigid if the message is not: a quaternion whose length is not 1, or numbers that are not
/// finite.
Eigen::Isometry3d pose_from_message(const geometry_msgs::Pose& pose);

}  // namespace facet_mapping
