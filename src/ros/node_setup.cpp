// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/node_setup.h"

#include <stdexcept>

#include <ros/console.h>

#include "facet_mapping/ros/file_paths.h"

namespace facet_mapping {

LabelSet set_up_node(const ParameterTable& table,
                     const ros::NodeHandle& private_nh,
                     std::string* label_file) {
  std::string problems;
  try {
    load_parameters(table, private_nh);
  } catch (const ConfigError& e) {
    problems = e.what();
  }
  LabelSet labels;
  try {
    *label_file = label_file_path(*label_file);
    labels = LabelSet::load(*label_file);
  } catch (const std::exception& e) {
    problems += (problems.empty() ? private_nh.getNamespace() + ":" : "") + "\n  - " + e.what();
  }
  if (!problems.empty()) {
    throw ConfigError(problems);
  }
  ROS_INFO("%s: parameters:%s", private_nh.getNamespace().c_str(), table.to_text().c_str());
#ifndef __OPTIMIZE__
  ROS_WARN("built without optimisation: much slower than -DCMAKE_BUILD_TYPE=Release");
#endif
  return labels;
}

}  // namespace facet_mapping
