// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <numeric>
#include <utility>

#include "carving/surface.h"

namespace facet_mapping::carving {
namespace {

constexpr std::uint32_t kUnused = 0xFFFFFFFF;

/// Which vertices are joined by facets.
class VertexSets {
 public:
  explicit VertexSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  std::uint32_t root(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) {
      parent_[vertex] = parent_[parent_[vertex]];
      vertex = parent_[vertex];
    }
    return vertex;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

template <typename T>
void keep_only(const std::vector<bool>& keep, std::vector<T>* values) {
  std::size_t end = 0;
  for (std::size_t k = 0; k < values->size(); ++k) {
    if (keep[k]) {
      (*values)[end++] = (*values)[k];
    }
  }
  values->resize(end);
}

void drop_unused_vertices(CarvedSurface* surface) {
  TriangleMesh& mesh = surface->mesh;
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kUnused);
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      used[v] = true;
    }
  }
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    new_index[v] = used[v] ? next++ : kUnused;
  }
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) {
      v = new_index[v];
    }
  }
  keep_only(used, &mesh.vertices);
  keep_only(used, &surface->vertex_ids);
}

}  // namespace

CarvedSurface without_small_parts(CarvedSurface surface, std::size_t min_facets) {
  TriangleMesh& mesh = surface.mesh;
  VertexSets parts(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[1], t[2]);
  }
  std::vector<std::size_t> facets(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    ++facets[parts.root(t[0])];
  }
  std::vector<bool> keep(mesh.triangles.size());
  bool keeps_all = true;
  for (std::size_t f = 0; f < keep.size(); ++f) {
    keep[f] = facets[parts.root(mesh.triangles[f][0])] >= min_facets;
    keeps_all = keeps_all && keep[f];
  }
  if (keeps_all) {
    return surface;
  }
  keep_only(keep, &mesh.triangles);
  keep_only(keep, &mesh.labels);
  keep_only(keep, &mesh.confidence);
  keep_only(keep, &mesh.views);
  drop_unused_vertices(&surface);
  return surface;
}

}  // namespace facet_mapping::carving
