// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/manifold.h"

#include <algorithm>
#include <sstream>
#include <tuple>

namespace facet_mapping {
namespace {

struct Edge {
  std::uint32_t low;
  std::uint32_t high;
  bool forward;

  bool same_vertices(const Edge& other) const { return low == other.low && high == other.high; }
  bool operator<(const Edge& other) const {
    return std::tie(low, high, forward) < std::tie(other.low, other.high, other.forward);
  }
};

bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void check_edges(const TriangleMesh& mesh, ManifoldReport* report) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int side = 0; side < 3; ++side) {
      const std::uint32_t a = t[side];
      const std::uint32_t b = t[(side + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end].same_vertices(edges[begin])) {
      ++end;
    }
    if (end - begin == 1) {
      ++report->open_edges;
    } else if (end - begin > 2) {
      ++report->non_manifold_edges;
    } else if (edges[begin].forward == edges[begin + 1].forward) {
      ++report->misoriented_edges;
    }
    begin = end;
  }
}

/// Counts the fans of facets around `vertex`, two facets being joined if they share a second
/// vertex.
std::size_t count_fans(const TriangleMesh& mesh, const Adjacency& rows, std::uint32_t vertex) {
  const std::size_t count = rows.size(vertex);
  std::vector<std::size_t> parent(count);
  std::vector<std::pair<std::uint32_t, std::size_t>> spokes;
  for (std::size_t k = 0; k < count; ++k) {
    parent[k] = k;
    for (const std::uint32_t v : mesh.triangles[rows.begin(vertex)[k]]) {
      if (v != vertex) {
        spokes.emplace_back(v, k);
      }
    }
  }
  const auto root = [&parent](std::size_t k) {
    while (parent[k] != k) {
      k = parent[k];
    }
    return k;
  };
  std::sort(spokes.begin(), spokes.end());
  std::size_t fans = count;
  for (std::size_t s = 1; s < spokes.size(); ++s) {
    if (spokes[s].first == spokes[s - 1].first) {
      const std::size_t a = root(spokes[s].second);
      const std::size_t b = root(spokes[s - 1].second);
      fans -= a == b ? 0 : 1;
      parent[a] = b;
    }
  }
  return fans;
}

}  // namespace

bool ManifoldReport::is_closed_manifold() const {
  return degenerate_facets == 0 && open_edges == 0 && non_manifold_edges == 0 &&
         misoriented_edges == 0 && non_manifold_vertices == 0;
}

std::string ManifoldReport::to_string() const {
  if (is_closed_manifold()) {
    return "closed 2-manifold";
  }
  std::ostringstream text;
  text << degenerate_facets << " degenerate facets, " << open_edges << " open edges, "
       << non_manifold_edges << " non-manifold edges, " << misoriented_edges
       << " misoriented edges, " << non_manifold_vertices << " non-manifold vertices";
  return text.str();
}

ManifoldReport check_manifold(const TriangleMesh& mesh) {
  ManifoldReport report;
  for (const Triangle& triangle : mesh.triangles) {
    report.degenerate_facets += is_degenerate(triangle) ? 1 : 0;
  }
  check_edges(mesh, &report);
  const Adjacency rows = vertex_facets(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    report.non_manifold_vertices += count_fans(mesh, rows, v) > 1 ? 1 : 0;
  }
  return report;
}

}  // namespace facet_mapping
