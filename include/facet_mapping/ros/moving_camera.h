// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the nodes for one moving camera (feature tracks, plane sweeping) share: posed images in, the
// clouds of earlier images out.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/points/labeled_point.h"
#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/posed_images.h"
#include "facet_mapping/ros/transform_queue.h"

namespace facet_mapping {

/// Subscribes image_rect, camera_info, segmentation and tf; publishes `points`, each cloud with the
/// header of the image that it belongs to, images later. Works only while somebody listens.
class MovingCamera {
 public:
  /// How the points are made. Both are called in the thread of the worker, one at a time.
  struct Source {
    /// Takes one more image and returns the frames that are complete now. `used` is set if the
    /// image moved enough to be used.
    std::function<std::vector<PointFrame>(const LabeledView& view, bool* used)> add;
    /// Returns the frames still held back; the source is as new afterwards.
    std::function<std::vector<PointFrame>()> finish;
  };

  /// `labels`, `diagnostics` and what the source uses must outlive this.
  MovingCamera(const ros::NodeHandle& nh,
               const MovingCameraConfig& config,
               const LabelSet& labels,
               NodeDiagnostics* diagnostics,
               Source source);
  ~MovingCamera();

  /// Ends the work; returns when the running image is done.
  void stop();

 private:
  /// An image whose cloud is still to come.
  struct Pending {
    double stamp = 0.0;
    std_msgs::Header header;
    std::vector<LabeledPoint> sky;
  };

  bool is_listened_to();
  void on_image(LabeledView view, const std_msgs::Header& header);
  void on_time_jump(double jump_s);
  void work(const LabeledView& view, const std_msgs::Header& header);
  void look_for_standstill(double stamp);
  void flush();
  void flush_if_idle();
  void publish(const std::vector<PointFrame>& frames);
  void publish_sky_before(double stamp);
  void refresh_diagnostics();

  MovingCameraConfig config_;
  const LabelSet& labels_;
  NodeDiagnostics* diagnostics_;
  Source source_;
  tf2_ros::Buffer tf_buffer_{ros::Duration(kTfCacheS)};
  tf2_ros::TransformListener tf_listener_;
  TransformQueue transforms_;
  std::deque<Pending> pending_;  // this and the next four: in the worker's thread
  std::size_t used_ = 0;
  std::size_t unused_ = 0;
  std::size_t used_since_flush_ = 0;
  double last_used_stamp_ = 0.0;
  ros::WallTime last_image_;
  bool is_flushed_ = true;
  ros::Publisher points_pub_;
  ros::WallTimer idle_timer_;
  JobQueue jobs_;
  PosedImages images_;  // last: its callbacks use all the others
};

}  // namespace facet_mapping
