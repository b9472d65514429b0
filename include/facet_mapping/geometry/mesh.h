// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The labelled triangle mesh that every room exchanges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping {

/// Vertex indices, counter-clockwise seen from free space.
using Triangle = std::array<std::uint32_t, 3>;

/// Attributes are either empty (absent) or hold one entry per triangle, or per vertex.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< map frame, metres
  std::vector<Triangle> triangles;
  std::vector<Label> labels;      ///< class per facet, kUnlabelled where none is known
  std::vector<float> confidence;  ///< margin between the best and the second class, 0..1
  /// Number of images (or rays, before any image was looked at) that see the facet. 0 says that it
  /// only closes the surface through space that nobody saw: see is_gap.
  std::vector<std::uint16_t> views;
  /// Per vertex, where it lay on the surface that refinement started from, map frame, metres.
  std::vector<Eigen::Vector3d> start_points;

  bool empty() const { return triangles.empty(); }
};

/// Throws std::invalid_argument naming the first attribute of wrong length, index out of range or
/// vertex that is not finite.
void validate(const TriangleMesh& mesh);

/// True if the facet only closes the surface: it is no evidence of matter, and images look through
/// it.
inline bool is_gap(const TriangleMesh& mesh, std::size_t facet) {
  return !mesh.views.empty() && mesh.views[facet] == 0;
}

/// Bytes of memory held beside the object itself, spare capacity included.
template <typename Value>
std::size_t bytes_of(const std::vector<Value>& values) {
  return values.capacity() * sizeof(Value);
}
std::size_t bytes_of(const TriangleMesh& mesh);

/// (b - a) x (c - a): normal times twice the area, pointing to free space.
Eigen::Vector3d facet_cross(const TriangleMesh& mesh, std::size_t facet);

/// Unit normals per facet; zero for degenerate facets.
std::vector<Eigen::Vector3d> facet_normals(const TriangleMesh& mesh);

/// Unit normals per vertex, area-weighted; zero where no facet with area meets the vertex.
std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh);

/// Neighbours of a facet over its edges (0-1, 1-2, 2-0); -1 where the edge has no single partner.
using FacetNeighbours = std::array<std::int32_t, 3>;
std::vector<FacetNeighbours> facet_neighbours(const TriangleMesh& mesh);

/// Compressed rows: the items of row k are items[offsets[k]] .. items[offsets[k + 1] - 1].
struct Adjacency {
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> items;

  const std::uint32_t* begin(std::size_t row) const { return items.data() + offsets[row]; }
  const std::uint32_t* end(std::size_t row) const { return items.data() + offsets[row + 1]; }
  std::size_t size(std::size_t row) const { return offsets[row + 1] - offsets[row]; }
};

/// For each vertex the facets that use it, in ascending order.
Adjacency vertex_facets(const TriangleMesh& mesh);

/// For each vertex the vertices joined to it by an edge, in ascending order.
Adjacency vertex_neighbours(const TriangleMesh& mesh);

/// The values whose `keep` is true, in their order; none of an attribute that is not there (empty).
template <typename Value>
std::vector<Value> select_values(const std::vector<Value>& values, const std::vector<bool>& keep) {
  std::vector<Value> selected;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (keep[k]) {
      selected.push_back(values[k]);
    }
  }
  return selected;
}

/// The facets with `keep[facet]` true, with unused vertices dropped and attributes carried along.
TriangleMesh select_facets(const TriangleMesh& mesh, const std::vector<bool>& keep);

}  // namespace facet_mapping
