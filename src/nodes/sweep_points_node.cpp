// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/sweep_points_node.h"

#include "facet_mapping/ros/node_main.h"

int main(int argc, char** argv) {
  return facet_mapping::run_node<facet_mapping::SweepPointsNode>(argc, argv, "sweep_points");
}
