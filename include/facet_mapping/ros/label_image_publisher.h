// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ~label_image: the mesh's classes rendered back into the newest keyframe.
#pragma once

#include <functional>

#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/keyframe_store.h"
#include "facet_mapping/ros/mesh_publisher.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

/// Publishes ~label_image (class ids: mono8 with 255 = unlabelled, mono16 with 65535 where the
/// class list has ids above 254) and ~label_image_color (bgr8). Rendering happens in a thread of
/// its own, and only if somebody subscribes; what comes while it is busy is skipped.
class LabelImagePublisher {
 public:
  LabelImagePublisher(ros::NodeHandle private_nh,
                      const LabelSet& labels,
                      std::function<MeshStatePtr()> mesh,
                      const KeyframeStore* keyframes,
                      NodeDiagnostics* diagnostics);

  /// Call after each new keyframe; `header` is that of its image.
  void update(const std_msgs::Header& header);
  void stop() { jobs_.stop(); }

 private:
  void render(const std_msgs::Header& header);

  LabelSet labels_;
  std::function<MeshStatePtr()> mesh_;
  const KeyframeStore* keyframes_;
  bool wide_ids_ = false;
  ros::Publisher ids_pub_;
  ros::Publisher color_pub_;
  JobQueue jobs_;
};

}  // namespace facet_mapping
