// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every node does first.
#pragma once

#include <string>

#include <ros/node_handle.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/ros/parameters.h"

namespace facet_mapping {

/// Reads the parameters and the class list that `label_file` (a member of the config behind the
/// table) names, and logs them. `label_file` becomes an absolute path. Throws ConfigError with all
/// problems at once.
LabelSet set_up_node(const ParameterTable& table,
                     const ros::NodeHandle& private_nh,
                     std::string* label_file);

}  // namespace facet_mapping
