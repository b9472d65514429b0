// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pluginlib/class_list_macros.hpp>

#include "facet_mapping/ros/node_main.h"
#include "facet_mapping/ros/sweep_points_node.h"

namespace facet_mapping {

class SweepPointsNodelet : public NodeNodelet<SweepPointsNode> {};

}  // namespace facet_mapping

PLUGINLIB_EXPORT_CLASS(facet_mapping::SweepPointsNodelet, nodelet::Nodelet)
