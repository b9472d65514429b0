// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/sweep_points_node.h"

#include "facet_mapping/points/without_sky.h"
#include "facet_mapping/ros/node_setup.h"

namespace facet_mapping {
SweepPointsNode::SweepPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : labels_(set_up_node(
          parameter_table(&config_), private_nh, &config_.input.segmentation.label_file)),
      diagnostics_(nh, private_nh),
      sweeper_(without_sky(config_.sweep, labels_)),
      camera_(nh,
              config_.input,
              labels_,
              &diagnostics_,
              {[this](const LabeledView& view, bool* used) { return add(view, used); },
               [this] { return finish(); }}) {}

void SweepPointsNode::stop() {
  camera_.stop();
}

std::vector<PointFrame> SweepPointsNode::add(const LabeledView& view, bool* used) {
  SweepReport report;
  std::vector<PointFrame> frames =
      sweeper_.add(view.gray, view.view, view.labels, view.stamp, &report);
  *used = report.used;
  note(report);
  return frames;
}

std::vector<PointFrame> SweepPointsNode::finish() {
  SweepReport report;
  std::vector<PointFrame> frames = sweeper_.finish(&report);
  note(report);
  return frames;
}

void SweepPointsNode::note(const SweepReport& report) {
  diagnostics_.count("images swept", report.swept);
  diagnostics_.count("images that no other could be compared with", report.alone);
  diagnostics_.count("pixels swept", report.pixels);
  diagnostics_.count("pixels unsure", report.unsure);
  diagnostics_.count("pixels that other images disagree on", report.inconsistent);
  diagnostics_.count("pixels too uncertain", report.imprecise);
  diagnostics_.count("pixels out of range", report.out_of_range);
  diagnostics_.count("points unlike at full size", report.unlike);
  if (report.swept > 0) {
    diagnostics_.set("plane directions of the last image", static_cast<double>(report.directions));
    diagnostics_.set("planes of the last image", static_cast<double>(report.planes));
  }
  if (report.restarted) {
    diagnostics_.complain("sweeping restarted",
                          "the image size changed or time went back: what waited came out early");
  }
}

}  // namespace facet_mapping
