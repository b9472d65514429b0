// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pluginlib/class_list_macros.hpp>

#include "facet_mapping/ros/node_main.h"
#include "facet_mapping/ros/track_points_node.h"

namespace facet_mapping {

class TrackPointsNodelet : public NodeNodelet<TrackPointsNode> {};

}  // namespace facet_mapping

PLUGINLIB_EXPORT_CLASS(facet_mapping::TrackPointsNodelet, nodelet::Nodelet)
