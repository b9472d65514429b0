// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_server_node.h"

#include "facet_mapping/ros/node_main.h"

int main(int argc, char** argv) {
  return facet_mapping::run_node<facet_mapping::MeshServerNode>(argc, argv, "mesh_server");
}
