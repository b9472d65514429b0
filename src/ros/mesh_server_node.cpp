// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_server_node.h"

#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "facet_mapping/ros/file_paths.h"
#include "facet_mapping/ros/node_setup.h"
#include "facet_mapping/ros/service_status.h"

namespace facet_mapping {
namespace {

constexpr char kHowToGetAMesh[] =
    "give a file as parameter `mesh` at the start, or call ~load_mesh with its path";

/// As set_up_node(), but without a label file the class list is empty.
LabelSet set_up(MeshServerNodeConfig* config, const ros::NodeHandle& private_nh) {
  const ParameterTable table = parameter_table(config);
  if (!private_nh.param<std::string>("label_file", "").empty()) {
    return set_up_node(table, private_nh, &config->label_file);
  }
  load_parameters(table, private_nh);
  ROS_INFO("%s: parameters:%s", private_nh.getNamespace().c_str(), table.to_text().c_str());
  return {};
}

}  // namespace

MeshServerNode::MeshServerNode(const ros::NodeHandle& nh, ros::NodeHandle private_nh)
    : labels_(set_up(&config_, private_nh)),
      diagnostics_(nh, private_nh),
      tf_listener_(tf_buffer_, nh),
      publisher_(private_nh, config_.map_frame, config_.output, labels_, config_.label_file),
      services_(private_nh, &publisher_, &tf_buffer_, kHowToGetAMesh) {
  tie_frame(config_.map_frame);
  if (!config_.mesh.empty()) {
    try {
      show(mesh_path(config_.mesh));
    } catch (const std::exception& e) {
      diagnostics_.complain("mesh not shown",
                            std::string(e.what()) + "; call ~load_mesh with another path");
    }
  }
  load_server_ = private_nh.advertiseService("load_mesh", &MeshServerNode::load_mesh, this);
}

bool MeshServerNode::load_mesh(LoadMesh::Request& request, LoadMesh::Response& response) {
  response.status = answer([&] {
    const std::string path = mesh_path(request.path);
    response.facets = show(path);
    response.path = path;
    return std::to_string(response.facets) + " facets of " + path + " in frame '" +
           publisher_.frame_id() + "'";
  });
  if (response.status.code != Status::OK) {
    diagnostics_.complain("mesh not shown", response.status.message);
  }
  return true;
}

std::size_t MeshServerNode::show(const std::string& path) {
  MeshFile file;
  try {
    file = read_ply(path);
  } catch (const std::runtime_error& e) {
    throw ServiceError(Status::IO_ERROR, e.what());
  }
  if (file.frame_id.empty()) {
    file.frame_id = config_.map_frame;
  }
  const bool has_own_list = labels_.empty();
  if (!has_own_list) {
    file.labels = labels_;
  }
  check_labels(file);
  tie_frame(file.frame_id);
  auto state = std::make_shared<MeshState>();
  state->mesh = std::move(file.mesh);
  state->stamp = ros::Time::now();
  const std::size_t facets = state->mesh.triangles.size();
  publisher_.replace(
      std::move(state), file.frame_id, file.labels, has_own_list ? path : config_.label_file);
  diagnostics_.count("meshes shown");
  diagnostics_.set("mesh", path);
  diagnostics_.set("facets", static_cast<double>(facets));
  return facets;
}

void MeshServerNode::check_labels(const MeshFile& file) {
  std::set<Label> unknown;
  for (const Label label : file.mesh.labels) {
    if (label != kUnlabelled && file.labels.find(label) == nullptr) {
      unknown.insert(label);
    }
  }
  if (unknown.empty()) {
    return;
  }
  std::string ids;
  for (const Label label : unknown) {
    ids += " " + std::to_string(label);
  }
  diagnostics_.complain("unknown classes",
                        "the class list has no class for the labels" + ids +
                            " of the mesh, which are shown grey; set label_file to the list that "
                            "the mesh was made with");
}

void MeshServerNode::tie_frame(const std::string& frame_id) {
  if (config_.tf_parent.empty() || config_.tf_parent == frame_id) {
    return;
  }
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time::now();
  transform.header.frame_id = config_.tf_parent;
  transform.child_frame_id = frame_id;
  transform.transform.rotation.w = 1.0;
  tf_broadcaster_.sendTransform(transform);
}

}  // namespace facet_mapping
