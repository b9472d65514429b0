// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ~get_mesh and ~save_mesh of a node that publishes a mesh.
#pragma once

#include <string>

#include <facet_mapping/GetMesh.h>
#include <facet_mapping/SaveMesh.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>

#include "facet_mapping/ros/mesh_publisher.h"

namespace facet_mapping {

class MeshServices {
 public:
  /// `how_to_get_one` ends the sentence "there is no mesh yet: ...".
  MeshServices(ros::NodeHandle private_nh,
               MeshPublisher* publisher,
               const tf2_ros::Buffer* buffer,
               const std::string& how_to_get_one);

 private:
  bool get_mesh(GetMesh::Request& request, GetMesh::Response& response);
  bool save_mesh(SaveMesh::Request& request, SaveMesh::Response& response);
  void require_mesh() const;
  MeshStatePtr mesh_within(const BoxRegion& region, const Eigen::Isometry3d& region_from_map) const;

  MeshPublisher* publisher_;
  const tf2_ros::Buffer* buffer_;
  std::string how_to_get_one_;
  ros::ServiceServer get_mesh_server_;
  ros::ServiceServer save_mesh_server_;
};

}  // namespace facet_mapping
