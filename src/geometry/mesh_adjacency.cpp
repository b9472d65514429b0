// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <tuple>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {
namespace {

struct HalfEdge {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t facet;
  std::uint32_t side;

  bool operator<(const HalfEdge& other) const {
    return std::tie(low, high, facet, side) <
           std::tie(other.low, other.high, other.facet, other.side);
  }
};

}  // namespace

std::vector<FacetNeighbours> facet_neighbours(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t a = mesh.triangles[f][side];
      const std::uint32_t b = mesh.triangles[f][(side + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), f, side});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<FacetNeighbours> neighbours(mesh.triangles.size(), {-1, -1, -1});
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high) {
      ++end;
    }
    if (end - begin == 2) {
      const HalfEdge& first = edges[begin];
      const HalfEdge& second = edges[begin + 1];
      neighbours[first.facet][first.side] = static_cast<std::int32_t>(second.facet);
      neighbours[second.facet][second.side] = static_cast<std::int32_t>(first.facet);
    }
    begin = end;
  }
  return neighbours;
}

Adjacency vertex_facets(const TriangleMesh& mesh) {
  Adjacency rows;
  rows.offsets.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      ++rows.offsets[v + 1];
    }
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    rows.offsets[v + 1] += rows.offsets[v];
  }
  rows.items.resize(rows.offsets.back());
  std::vector<std::uint32_t> cursor(rows.offsets.begin(), rows.offsets.end() - 1);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      rows.items[cursor[v]++] = f;
    }
  }
  return rows;
}

Adjacency vertex_neighbours(const TriangleMesh& mesh) {
  const Adjacency facets = vertex_facets(mesh);
  Adjacency rows;
  rows.offsets.reserve(mesh.vertices.size() + 1);
  rows.offsets.push_back(0);
  std::vector<std::uint32_t> ring;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    ring.clear();
    for (const std::uint32_t* f = facets.begin(v); f != facets.end(v); ++f) {
      for (const std::uint32_t other : mesh.triangles[*f]) {
        if (other != v) {
          ring.push_back(other);
        }
      }
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    rows.items.insert(rows.items.end(), ring.begin(), ring.end());
    rows.offsets.push_back(static_cast<std::uint32_t>(rows.items.size()));
  }
  return rows;
}

}  // namespace facet_mapping
