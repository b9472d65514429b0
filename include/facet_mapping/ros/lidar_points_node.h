// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// lidar_points: scans, the segmentation of a camera and tf -> clean, motion-compensated, labelled
// points.
#pragma once

#include <string>

#include <boost/shared_ptr.hpp>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/points/lidar_accumulator.h"
#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/lidar_points_labels.h"
#include "facet_mapping/ros/lidar_points_node_config.h"
#include "facet_mapping/ros/lidar_points_scan.h"
#include "facet_mapping/ros/lidar_points_worker.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/segmentation_reader.h"
#include "facet_mapping/ros/time_jump.h"
#include "facet_mapping/ros/transform_queue.h"

namespace facet_mapping {

/// A scan goes from the accumulator to its label image, then to the poses of its sensor and of the
/// camera, then to the worker's thread.
class LidarPointsNode {
 public:
  using Config = LidarPointsNodeConfig;

  /// Throws ConfigError.
  LidarPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh);
  ~LidarPointsNode();

  /// Ends the work; returns when the running scan is done.
  void stop();

 private:
  struct Frame;  // a scan on its way
  using FramePtr = boost::shared_ptr<Frame>;

  void subscribe(ros::NodeHandle nh);
  void receive(const sensor_msgs::PointCloud2ConstPtr& cloud);
  bool is_wanted(const std_msgs::Header& header);
  void check_time(const std::string& source, const ros::Time& stamp);
  void note_times(const CloudTimes& times);
  void gather(LidarScan scan, const std_msgs::Header& header);
  void finish_frame();
  void accept(LidarScan scan, const std_msgs::Header& header);
  void set_labels(const FramePtr& frame, const NearestLabels::Image& image);
  std::string unusable_labels(const NearestLabels::Image& image) const;
  void find_sensor(const FramePtr& frame);
  void sample_path(const FramePtr& frame) const;
  void find_camera(const FramePtr& frame);
  void post(const FramePtr& frame);
  void work(const FramePtr& frame);
  void publish(const PointFrame& points, const std_msgs::Header& header);
  void note(const LidarJobReport& report);
  void refresh_diagnostics();

  Config config_;
  LabelSet labels_;
  NodeDiagnostics diagnostics_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  TransformQueue transforms_;
  SegmentationReader segmentation_;
  NearestLabels nearest_;
  ScanAccumulator accumulator_;
  std_msgs::Header gathered_;  // of the accumulator's newest scan
  ros::WallTime gathered_at_;  // its arrival
  TimeJumpDetector time_jump_;
  std::string cloud_topic_;
  std::string info_topic_;
  sensor_msgs::CameraInfoConstPtr info_;
  ros::Publisher points_pub_;
  ros::Subscriber cloud_subscriber_;
  ros::Subscriber info_subscriber_;
  ros::WallTimer poll_timer_;
  LidarPointsWorker worker_;
  JobQueue jobs_;
};

}  // namespace facet_mapping
