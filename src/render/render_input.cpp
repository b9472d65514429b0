// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/render_input.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace facet_mapping {
namespace {

constexpr int kMaxImageSide = 65536;

void check_camera(const PinholeCamera& camera) {
  if (!camera.is_valid()) {
    throw std::invalid_argument(
        "render: the camera needs a positive size, positive focal lengths and finite numbers");
  }
  if (std::max(camera.width, camera.height) > kMaxImageSide) {
    throw std::invalid_argument("render: images of more than " + std::to_string(kMaxImageSide) +
                                " pixels a side are not supported");
  }
}

void check_indices(const TriangleMesh& mesh) {
  std::uint32_t largest = 0;
  for (const Triangle& t : mesh.triangles) {
    largest = std::max({largest, t[0], t[1], t[2]});
  }
  if (!mesh.triangles.empty() && largest >= mesh.vertices.size()) {
    throw std::invalid_argument("render: a facet names vertex " + std::to_string(largest) +
                                " of only " + std::to_string(mesh.vertices.size()));
  }
}

}  // namespace

void check_render_input(const TriangleMesh& mesh, const View& view) {
  check_camera(view.camera);
  if (!is_rigid(view.world_from_cam)) {
    throw std::invalid_argument("render: the pose of the view is not a rigid transform");
  }
  check_indices(mesh);
}

void throw_vertex_not_finite(std::size_t vertex) {
  throw std::invalid_argument("render: vertex " + std::to_string(vertex) + " is not finite");
}

}  // namespace facet_mapping
