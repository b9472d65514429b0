// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// mesh_server: a saved mesh on the mapper's topics and services, with no mapper running.
#pragma once

#include <string>

#include <facet_mapping/LoadMesh.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include "facet_mapping/io/ply.h"
#include "facet_mapping/ros/mesh_publisher.h"
#include "facet_mapping/ros/mesh_server_node_config.h"
#include "facet_mapping/ros/mesh_services.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

class MeshServerNode {
 public:
  using Config = MeshServerNodeConfig;

  /// Throws ConfigError. A mesh that cannot be read is only a complaint: another may be loaded.
  MeshServerNode(const ros::NodeHandle& nh, ros::NodeHandle private_nh);

  void stop() {}

 private:
  bool load_mesh(LoadMesh::Request& request, LoadMesh::Response& response);
  /// Shows the file at an absolute path and returns its number of facets.
  /// Throws ServiceError (IO_ERROR); what was shown then stays.
  std::size_t show(const std::string& path);
  /// Says which labels of the mesh the class list does not have.
  void check_labels(const MeshFile& file);
  void tie_frame(const std::string& frame_id);

  Config config_;
  LabelSet labels_;  // of the label file; empty: each mesh brings its own
  NodeDiagnostics diagnostics_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  tf2_ros::StaticTransformBroadcaster tf_broadcaster_;
  MeshPublisher publisher_;
  MeshServices services_;
  ros::ServiceServer load_server_;
};

}  // namespace facet_mapping
