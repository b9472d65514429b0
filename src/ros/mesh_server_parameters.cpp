// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

#include "facet_mapping/ros/mesh_server_node_config.h"

namespace facet_mapping {

ParameterTable parameter_table(MeshServerNodeConfig* config) {
  ParameterTable table;
  table.add("mesh",
            &config->mesh,
            "PLY file to show first; `~` is the home folder, a relative path starts at ROS_HOME; "
            "empty: none until `~load_mesh`");
  table.add("label_file",
            &config->label_file,
            "class list: a path, or a shipped one (cityscapes, kitti360, semantic_kitti, ade20k); "
            "empty: the one in the PLY's comments");
  table.add("map_frame", &config->map_frame, "frame of a mesh whose file names none");
  table.add("tf_parent",
            &config->tf_parent,
            "frame to which the mesh's frame is tied by an identity on `/tf_static`, so that rviz "
            "can show a mesh of any frame; empty: no transform");
  add_output(&table, &config->output);
  table.add_check([config]() -> std::string {
    return config->map_frame.empty() ? "'map_frame' is empty; give a frame, e.g. map" : "";
  });
  return table;
}

}  // namespace facet_mapping
