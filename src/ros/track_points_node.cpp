// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/track_points_node.h"

#include "facet_mapping/points/without_sky.h"
#include "facet_mapping/ros/node_setup.h"

namespace facet_mapping {
TrackPointsNode::TrackPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : labels_(set_up_node(
          parameter_table(&config_), private_nh, &config_.input.segmentation.label_file)),
      diagnostics_(nh, private_nh),
      tracker_(without_sky(config_.tracks, labels_)),
      camera_(nh,
              config_.input,
              labels_,
              &diagnostics_,
              {[this](const LabeledView& view, bool* used) { return add(view, used); },
               [this] { return tracker_.finish(); }}) {}

void TrackPointsNode::stop() {
  camera_.stop();
}

std::vector<PointFrame> TrackPointsNode::add(const LabeledView& view, bool* used) {
  TrackReport report;
  std::vector<PointFrame> frames =
      tracker_.add(view.gray, view.view, view.labels, view.stamp, &report);
  *used = report.used;
  note(report);
  return frames;
}

void TrackPointsNode::note(const TrackReport& report) {
  diagnostics_.count("tracks followed", report.followed);
  diagnostics_.count("tracks found again", report.matched);
  diagnostics_.count("tracks without a match", report.no_match);
  diagnostics_.count("tracks with two matches", report.ambiguous);
  diagnostics_.count("tracks off their epipolar line", report.off_epipolar);
  diagnostics_.count("tracks without a common point", report.inconsistent);
  diagnostics_.count("observations of too few images", report.too_few_views);
  diagnostics_.count("observations too uncertain", report.imprecise);
  diagnostics_.count("observations out of range", report.out_of_range);
  if (report.restarted) {
    diagnostics_.complain(
        "tracks restarted",
        "nearly all tracks were lost at once: the image size or the time changed, "
        "or the pose jumped; check tf (a loop closure between map and odom? then "
        "set map_frame to odom)");
  }
}

}  // namespace facet_mapping
