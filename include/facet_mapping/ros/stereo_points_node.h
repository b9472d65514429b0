// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// stereo_points: a rectified pair and its segmentation -> labelled points.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/segmentation_reader.h"
#include "facet_mapping/ros/stamp_sync.h"
#include "facet_mapping/ros/time_jump.h"

namespace facet_mapping {

class StereoPointsNode {
 public:
  using Config = StereoPointsNodeConfig;

  /// Throws ConfigError.
  StereoPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh);
  ~StereoPointsNode();

  /// Ends the work; returns when the running pair is done.
  void stop();

 private:
  struct Pair;

  void subscribe(ros::NodeHandle nh);
  template <typename Message>
  ros::Subscriber subscribe_part(ros::NodeHandle* nh, const std::string& topic, int part);
  void receive(int part, const ros::Time& stamp, boost::shared_ptr<const void> message);
  void accept(const StampedParts& parts);
  boost::shared_ptr<const sensor_msgs::CameraInfo> info_of(const StampedParts& parts, int part);
  Pair convert(const StampedParts& parts);
  void match(const Pair& pair);
  /// Complains if the images cannot be a rectified pair; looks at the first pairs, then now and
  /// then.
  void check(const Pair& pair);
  void refresh_diagnostics();

  Config config_;
  LabelSet labels_;
  NodeDiagnostics diagnostics_;
  SegmentationReader segmentation_;
  StampSync sync_;
  TimeJumpDetector time_jump_;
  std::size_t unpaired_ = 0;  // of sync_, as far as complained about
  std::vector<std::string> topics_;
  boost::shared_ptr<const sensor_msgs::CameraInfo> last_info_[2];
  std::size_t matched_pairs_ = 0;  // by the thread of jobs_
  ros::Publisher points_pub_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer poll_timer_;
  JobQueue jobs_;
};

}  // namespace facet_mapping
