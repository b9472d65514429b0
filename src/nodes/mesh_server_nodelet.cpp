// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pluginlib/class_list_macros.hpp>

#include "facet_mapping/ros/mesh_server_node.h"
#include "facet_mapping/ros/node_main.h"

namespace facet_mapping {

class MeshServerNodelet : public NodeNodelet<MeshServerNode> {};

}  // namespace facet_mapping

PLUGINLIB_EXPORT_CLASS(facet_mapping::MeshServerNodelet, nodelet::Nodelet)
