// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames wait here until tf knows their pose at their stamp.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <string>

#include <Eigen/Geometry>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <tf2_ros/buffer.h>

#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

/// How far back a node remembers tf: clouds of slow sources come long after their images.
constexpr double kTfCacheS = 60.0;

/// All calls and callbacks in the thread of the node's callback queue.
class TransformQueue {
 public:
  using Ready = std::function<void(const Eigen::Isometry3d& map_from_sensor)>;

  TransformQueue(const ros::NodeHandle& nh,
                 const tf2_ros::Buffer* buffer,
                 const PoseInput& config,
                 NodeDiagnostics* diagnostics);

  /// Calls `ready` now or later with the pose of `frame_id` at `stamp`; never, if tf does not know
  /// it within the timeout: then the drop is counted and explained.
  void push(const std::string& frame_id, const ros::Time& stamp, Ready ready);
  void clear();
  std::size_t size() const { return waiting_.size(); }

 private:
  struct Waiting {
    std::string frame_id;
    ros::Time stamp;
    ros::WallTime arrival;
    Ready ready;
  };

  bool try_resolve(const Waiting& item, std::string* error);
  void poll();
  void drop(const Waiting& item, const std::string& error);

  const tf2_ros::Buffer* buffer_;
  PoseInput config_;
  NodeDiagnostics* diagnostics_;
  std::deque<Waiting> waiting_;
  ros::WallTimer timer_;
};

/// tf2 knows no leading slash, but old drivers still send it.
std::string without_slash(const std::string& frame_id);

/// One sentence for a pose that tf does not know: both frames, the stamp, what tf knows of the
/// chain between them, and what to do. `error` is tf's own text.
std::string explain_missing_transform(const tf2_ros::Buffer& buffer,
                                      const std::string& map_frame,
                                      const std::string& frame_id,
                                      const ros::Time& stamp,
                                      double waited_s,
                                      const std::string& error);

}  // namespace facet_mapping
