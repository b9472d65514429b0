// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace facet_mapping {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// Which local axis the corners' plane faces most.
int facing_axis(const std::array<Eigen::Vector3d, 4>& corners) {
  const Eigen::Vector3d normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return axis;
}

Eigen::Vector3f flat_texture(const Eigen::Vector3d& p, int axis) {
  switch (axis) {
    case 0:
      return Eigen::Vector3d(p.y(), p.z(), p.x()).cast<float>();
    case 1:
      return Eigen::Vector3d(p.x(), p.z(), p.y()).cast<float>();
    default:
      return p.cast<float>();
  }
}

}  // namespace

std::uint16_t SceneBuilder::add_material(const Material& material) {
  if (street_->materials.size() >= std::numeric_limits<std::uint16_t>::max()) {
    throw std::invalid_argument("synthetic street: too long, its materials do not fit 16 bits");
  }
  street_->materials.push_back(material);
  return static_cast<std::uint16_t>(street_->materials.size() - 1);
}

void SceneBuilder::begin_part(const Eigen::Isometry3d& map_from_local) {
  end_part();
  StreetPart part;
  part.first_vertex = static_cast<std::uint32_t>(street_->mesh.vertices.size());
  part.first_facet = static_cast<std::uint32_t>(street_->mesh.triangles.size());
  street_->parts.push_back(part);
  map_from_local_ = map_from_local;
}

void SceneBuilder::finish() {
  end_part();
}

void SceneBuilder::end_part() {
  if (street_->parts.empty()) {
    return;
  }
  const TriangleMesh& mesh = street_->mesh;
  StreetPart& part = street_->parts.back();
  part.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size()) - part.first_vertex;
  part.facet_count = static_cast<std::uint32_t>(mesh.triangles.size()) - part.first_facet;
  if (part.facet_count == 0) {
    street_->parts.pop_back();
    return;
  }
  Eigen::AlignedBox3d box;
  for (std::uint32_t v = 0; v < part.vertex_count; ++v) {
    box.extend(mesh.vertices[part.first_vertex + v]);
  }
  part.center = box.center();
  part.radius = 0.5 * box.diagonal().norm();
  set_normals(part);
}

void SceneBuilder::set_normals(const StreetPart& part) {
  std::vector<Eigen::Vector3f>& normals = street_->normals;
  normals.resize(street_->mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (std::uint32_t f = part.first_facet; f < part.first_facet + part.facet_count; ++f) {
    const Eigen::Vector3f cross = facet_cross(street_->mesh, f).cast<float>();
    for (const std::uint32_t v : street_->mesh.triangles[f]) {
      normals[v] += cross;
    }
  }
  for (std::uint32_t v = part.first_vertex; v < normals.size(); ++v) {
    normals[v].normalize();
  }
}

std::uint32_t SceneBuilder::add_vertex(const SceneVertex& vertex) {
  street_->mesh.vertices.emplace_back(map_from_local_ * vertex.position);
  street_->texture.push_back(vertex.texture);
  return static_cast<std::uint32_t>(street_->mesh.vertices.size() - 1);
}

void SceneBuilder::add_triangle(std::uint32_t a,
                                std::uint32_t b,
                                std::uint32_t c,
                                const Surface& surface) {
  street_->mesh.triangles.push_back({a, b, c});
  street_->mesh.labels.push_back(surface.label);
  street_->material.push_back(surface.material);
}

void SceneBuilder::add_grid(
    int rows, int columns, const GridVertex& vertex, const Surface& surface, const GridCell& keep) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  const std::size_t stride = static_cast<std::size_t>(columns) + 1;
  std::vector<std::uint32_t> index(stride * (static_cast<std::size_t>(rows) + 1), kUnused);
  const auto at = [&](int r, int c) {
    std::uint32_t& entry = index[static_cast<std::size_t>(r) * stride + c];
    if (entry == kUnused) {
      entry = add_vertex(vertex(r, c));
    }
    return entry;
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (keep && !keep(r, c)) {
        continue;
      }
      const std::array<std::uint32_t, 4> q{at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)};
      add_triangle(q[0], q[1], q[2], surface);
      add_triangle(q[0], q[2], q[3], surface);
    }
  }
}

void SceneBuilder::add_quad(const Quad& quad, const Surface& surface) {
  const std::uint32_t a = add_vertex(quad[0]);
  add_vertex(quad[1]);
  add_vertex(quad[2]);
  add_vertex(quad[3]);
  add_triangle(a, a + 1, a + 2, surface);
  add_triangle(a, a + 2, a + 3, surface);
}

void SceneBuilder::add_flat(const std::array<Eigen::Vector3d, 4>& corners, const Surface& surface) {
  const int axis = facing_axis(corners);
  Quad quad;
  for (int k = 0; k < 4; ++k) {
    quad[k] = {corners[k], flat_texture(corners[k], axis)};
  }
  add_quad(quad, surface);
}

void SceneBuilder::add_box(const Eigen::Vector3d& low,
                           const Eigen::Vector3d& high,
                           const Surface& surface,
                           const char* without) {
  const auto corner = [&](int x, int y, int z) {
    return Eigen::Vector3d(
        x != 0 ? high.x() : low.x(), y != 0 ? high.y() : low.y(), z != 0 ? high.z() : low.z());
  };
  const auto face = [&](char name, const std::array<Eigen::Vector3d, 4>& corners) {
    if (std::strchr(without, name) == nullptr) {
      add_flat(corners, surface);
    }
  };
  face('x', {corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1)});
  face('X', {corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)});
  face('y', {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)});
  face('Y', {corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1)});
  face('z', {corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0), corner(0, 0, 0)});
  face('Z', {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)});
}

void SceneBuilder::add_fan(const std::vector<SceneVertex>& ring, const Surface& surface) {
  SceneVertex middle;
  for (const SceneVertex& vertex : ring) {
    middle.position += vertex.position / static_cast<double>(ring.size());
    middle.texture += vertex.texture / static_cast<float>(ring.size());
  }
  const std::uint32_t center = add_vertex(middle);
  for (const SceneVertex& vertex : ring) {
    add_vertex(vertex);
  }
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t k = 0; k < count; ++k) {
    add_triangle(center, center + 1 + k, center + 1 + (k + 1) % count, surface);
  }
}

void add_tube(SceneBuilder* builder,
              const std::vector<TubeRing>& rings,
              int sides,
              const Surface& surface) {
  const auto vertex = [&](int side, int ring) {
    const double angle = kTwoPi * side / sides;
    const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
    SceneVertex v;
    v.position = rings[ring].center + rings[ring].radius * direction;
    v.texture = v.position.cast<float>();
    return v;
  };
  builder->add_grid(sides, static_cast<int>(rings.size()) - 1, vertex, surface);
}

}  // namespace facet_mapping
