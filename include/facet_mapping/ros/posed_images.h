// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// image_rect, camera_info, segmentation and tf -> images with pose and classes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "facet_mapping/labels/labeled_view.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/segmentation_reader.h"
#include "facet_mapping/ros/stamp_sync.h"
#include "facet_mapping/ros/time_jump.h"
#include "facet_mapping/ros/transform_queue.h"

namespace facet_mapping {

/// All calls and callbacks in the thread of the node's callback queue.
class PosedImages {
 public:
  struct Callbacks {
    /// Asked before an image is decoded; may be empty: all are wanted.
    std::function<bool(const Eigen::Isometry3d& map_from_camera)> is_wanted;
    /// The header is the image's.
    std::function<void(LabeledView, const std_msgs::Header&)> on_image;
    std::function<void(double jump_s)> on_time_jump;
  };

  PosedImages(ros::NodeHandle nh,
              const SegmentationInput& config,
              const LabelSet& labels,
              TransformQueue* transforms,
              NodeDiagnostics* diagnostics,
              Callbacks callbacks);

  /// Forgets the images that wait for a part.
  void clear() { sync_.clear(); }
  void refresh_diagnostics();

 private:
  void subscribe(ros::NodeHandle nh);
  void receive(int part, const ros::Time& stamp, boost::shared_ptr<const void> message);
  void look_up_pose(const StampedParts& parts);
  void accept(const StampedParts& parts, const Eigen::Isometry3d& map_from_camera);
  LabeledView convert(const StampedParts& parts);

  SegmentationInput config_;
  TransformQueue* transforms_;
  NodeDiagnostics* diagnostics_;
  Callbacks callbacks_;
  SegmentationReader segmentation_;
  StampSync sync_;
  TimeJumpDetector time_jump_;
  std::string image_topic_;
  std::string info_topic_;
  sensor_msgs::CameraInfoConstPtr last_info_;
  std::size_t unpaired_ = 0;
  ros::Subscriber image_subscriber_;
  ros::Subscriber info_subscriber_;
  ros::WallTimer poll_timer_;
};

}  // namespace facet_mapping
