// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// mapper: labelled points of any sensors -> the labelled surface of the drive.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include <facet_mapping/MeshStats.h>
#include <facet_mapping/Reset.h>
#include <ros/node_handle.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "facet_mapping/ros/corrected_poses.h"
#include "facet_mapping/ros/keyframe_path.h"
#include "facet_mapping/ros/map_worker.h"
#include "facet_mapping/ros/mesh_publisher.h"
#include "facet_mapping/ros/mesh_services.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/time_jump.h"
#include "facet_mapping/ros/transform_queue.h"

namespace facet_mapping {

class MapperNode {
 public:
  using Config = MapperNodeConfig;

  /// Throws ConfigError.
  MapperNode(ros::NodeHandle nh, ros::NodeHandle private_nh);
  ~MapperNode();

  /// Ends the work; returns when the running update is done.
  void stop();

 private:
  void receive(const std::string& topic, const sensor_msgs::PointCloud2ConstPtr& cloud);
  void check_time(const std::string& topic, const ros::Time& stamp);
  void enqueue(const std::string& topic, bool is_scan, PointFrame frame);
  void forget_everything();
  bool reset(Reset::Request& request, Reset::Response& response);
  void publish_stats();
  void fill_stats(MeshStats* stats) const;
  // In the worker's thread:
  void note_frame(const FrameReport& report);
  void note_cloud(const CloudReport& report);
  void publish_update(MapUpdate update);
  void note_update(const MapUpdate& update);

  Config config_;
  LabelSet labels_;
  NodeDiagnostics diagnostics_;
  tf2_ros::Buffer tf_buffer_{ros::Duration(kTfCacheS)};
  tf2_ros::TransformListener tf_listener_;
  TransformQueue transforms_;
  TimeJumpDetector time_jump_;
  MeshPublisher publisher_;
  MeshServices services_;
  ros::Publisher stats_pub_;
  ros::WallTimer stats_timer_;
  KeyframePath keyframe_path_;
  std::uint64_t bytes_at_start_ = 0;  // of the process's own memory
  mutable std::mutex update_mutex_;
  MapUpdate last_update_;  // without its surface
  ros::ServiceServer reset_server_;
  std::vector<ros::Subscriber> subscribers_;
  MapWorker worker_;
  CorrectedPoses corrected_poses_;
};

}  // namespace facet_mapping
