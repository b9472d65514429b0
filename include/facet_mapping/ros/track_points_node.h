// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// track_points: the images of one moving camera -> labelled points of tracked features.
#pragma once

#include <vector>

#include <ros/node_handle.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/points/track_points.h"
#include "facet_mapping/ros/moving_camera.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

class TrackPointsNode {
 public:
  using Config = TrackPointsNodeConfig;

  /// Throws ConfigError.
  TrackPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh);

  /// Ends the work; returns when the running image is done.
  void stop();

 private:
  std::vector<PointFrame> add(const LabeledView& view, bool* used);
  void note(const TrackReport& report);

  Config config_;
  LabelSet labels_;
  NodeDiagnostics diagnostics_;
  FeatureTracker tracker_;
  MovingCamera camera_;  // last: it uses all the others
};

}  // namespace facet_mapping
