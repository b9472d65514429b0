// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// segmenter: images -> class images with the images' exact headers.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/segmenter_node_config.h"
#include "facet_mapping/ros/time_jump.h"

namespace facet_mapping {

/// Subscribes image_rect; publishes segmentation (mono8, 255 unlabelled; mono16, 65535 unlabelled,
/// if the list has ids above 254) and segmentation_confidence (mono8, 255 certain).
class SegmenterNode {
 public:
  using Config = SegmenterNodeConfig;

  /// Throws ConfigError, and std::runtime_error on a model that cannot be used.
  SegmenterNode(ros::NodeHandle nh, ros::NodeHandle private_nh);
  ~SegmenterNode();

  /// Ends the work; returns when the running image is done.
  void stop();

 private:
  void receive(const sensor_msgs::ImageConstPtr& image);
  bool is_wanted(const ros::Time& stamp);
  void queue(const sensor_msgs::ImageConstPtr& image);
  void work_on_oldest();
  void segment(const sensor_msgs::Image& image);
  std::size_t waiting() const;

  Config config_;
  LabelSet labels_;
  NodeDiagnostics diagnostics_;
  std::unique_ptr<Segmenter> segmenter_;
  bool wide_ids_ = false;
  std::string topic_;
  TimeJumpDetector time_jump_;
  ros::Time last_stamp_;
  mutable std::mutex mutex_;
  std::deque<sensor_msgs::ImageConstPtr> waiting_;
  ros::Publisher labels_pub_;
  ros::Publisher confidence_pub_;
  ros::Subscriber subscriber_;
  JobQueue jobs_;
};

}  // namespace facet_mapping
