// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_services.h"

#include <memory>
#include <stdexcept>

#include "facet_mapping/io/ply.h"
#include "facet_mapping/ros/file_paths.h"
#include "facet_mapping/ros/mesh_filter.h"
#include "facet_mapping/ros/service_status.h"

namespace facet_mapping {
namespace {

std::string facets_text(std::size_t facets) {
  return std::to_string(facets) + " facets";
}

std::size_t count_facets(const LabeledMesh& message) {
  std::size_t facets = 0;
  for (const LabeledMeshChunk& chunk : message.chunks) {
    facets += chunk.triangles.size() / 3;
  }
  return facets;
}

/// Writes the file; what the disk refuses is an IO_ERROR.
void write_mesh(const std::string& path, const MeshFile& file) {
  try {
    write_ply(path, file);
  } catch (const std::runtime_error& e) {
    throw ServiceError(Status::IO_ERROR, e.what());
  }
}

}  // namespace

MeshServices::MeshServices(ros::NodeHandle private_nh,
                           MeshPublisher* publisher,
                           const tf2_ros::Buffer* buffer,
                           const std::string& how_to_get_one)
    : publisher_(publisher), buffer_(buffer), how_to_get_one_(how_to_get_one) {
  get_mesh_server_ = private_nh.advertiseService("get_mesh", &MeshServices::get_mesh, this);
  save_mesh_server_ = private_nh.advertiseService("save_mesh", &MeshServices::save_mesh, this);
}

void MeshServices::require_mesh() const {
  if (publisher_->facets() == 0) {
    throw ServiceError(Status::NOT_READY, "there is no mesh yet: " + how_to_get_one_);
  }
}

MeshStatePtr MeshServices::mesh_within(const BoxRegion& region,
                                       const Eigen::Isometry3d& region_from_map) const {
  try {
    const MeshStatePtr state =
        is_everywhere(region) ? publisher_->current()
                              : publisher_->current_within(box_in_map(region, region_from_map));
    return state ? state : std::make_shared<MeshState>();  // a reset may have come in between
  } catch (const std::runtime_error& e) {
    throw ServiceError(Status::IO_ERROR, e.what());
  }
}

bool MeshServices::get_mesh(GetMesh::Request& request, GetMesh::Response& response) {
  response.status = answer([&] {
    validate(request.region);
    require_mesh();
    if (is_everywhere(request.region) && request.classes.empty()) {
      response.mesh = publisher_->full_message();
      return facets_text(count_facets(response.mesh));
    }
    const Eigen::Isometry3d region_from_map =
        lookup_region_from_map(request.region, publisher_->frame_id(), *buffer_);
    const MeshStatePtr state = mesh_within(request.region, region_from_map);
    const TriangleMesh part =
        filter_mesh(state->mesh, request.region, region_from_map, request.classes);
    response.mesh = publisher_->detached_message(part, state->stamp);
    return facets_text(part.triangles.size()) + " of " + std::to_string(publisher_->facets());
  });
  return true;
}

bool MeshServices::save_mesh(SaveMesh::Request& request, SaveMesh::Response& response) {
  response.status = answer([&] {
    const std::string path = mesh_path(request.path);
    require_mesh();
    const MeshStatePtr state = mesh_within(BoxRegion(), Eigen::Isometry3d::Identity());
    const TriangleMesh part =
        filter_mesh(state->mesh, BoxRegion(), Eigen::Isometry3d::Identity(), request.classes);
    if (part.empty()) {
      throw std::invalid_argument("no facet has one of the classes asked for; nothing was written");
    }
    write_mesh(path, {part, publisher_->labels(), publisher_->frame_id()});
    response.path = path;
    response.facets = part.triangles.size();
    return facets_text(part.triangles.size()) + " written to " + path;
  });
  return true;
}

}  // namespace facet_mapping
