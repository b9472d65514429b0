// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// sweep_points: the images of one moving camera -> dense labelled points of plane sweeping.
#pragma once

#include <vector>

#include <ros/node_handle.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/points/sweep_points.h"
#include "facet_mapping/ros/moving_camera.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

class SweepPointsNode {
 public:
  using Config = SweepPointsNodeConfig;

  /// Throws ConfigError.
  SweepPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh);

  /// Ends the work; returns when the running image is done.
  void stop();

 private:
  std::vector<PointFrame> add(const LabeledView& view, bool* used);
  std::vector<PointFrame> finish();
  void note(const SweepReport& report);

  Config config_;
  LabelSet labels_;
  NodeDiagnostics diagnostics_;
  PlaneSweeper sweeper_;
  MovingCamera camera_;  // last: it uses all the others
};

}  // namespace facet_mapping
