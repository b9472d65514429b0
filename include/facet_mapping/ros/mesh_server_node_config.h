// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of the mesh_server node.
#pragma once

#include <string>

#include "facet_mapping/ros/node_config.h"

namespace facet_mapping {

struct MeshServerNodeConfig {
  std::string mesh;        ///< PLY file to show first; "": none
  std::string label_file;  ///< "": the class list in the file
  std::string map_frame = "map";
  std::string tf_parent;  ///< "": no transform is published
  MeshOutput output;
};

/// The table points into the struct, which must outlive it.
ParameterTable parameter_table(MeshServerNodeConfig* config);

}  // namespace facet_mapping
