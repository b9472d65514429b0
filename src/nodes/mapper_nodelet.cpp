// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pluginlib/class_list_macros.hpp>

#include "facet_mapping/ros/mapper_node.h"
#include "facet_mapping/ros/node_main.h"

namespace facet_mapping {

class MapperNodelet : public NodeNodelet<MapperNode> {};

}  // namespace facet_mapping

PLUGINLIB_EXPORT_CLASS(facet_mapping::MapperNodelet, nodelet::Nodelet)
