// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/facet_graph.h"

#include <algorithm>
#include <cmath>

#include "labeling/votes.h"

namespace facet_mapping {
namespace {

double edge_length(const TriangleMesh& mesh, std::uint32_t facet, std::size_t side) {
  const Triangle& t = mesh.triangles[facet];
  return (mesh.vertices[t[(side + 1) % 3]] - mesh.vertices[t[side]]).norm();
}

double mean_edge_length(const TriangleMesh& mesh, std::uint32_t facet) {
  return (edge_length(mesh, facet, 0) + edge_length(mesh, facet, 1) + edge_length(mesh, facet, 2)) /
         3.0;
}

/// The side of `facet` that runs along side `other_side` of `other`.
std::size_t matching_side(const TriangleMesh& mesh,
                          std::uint32_t facet,
                          std::uint32_t other,
                          std::size_t other_side) {
  const Triangle& t = mesh.triangles[facet];
  const Triangle& o = mesh.triangles[other];
  const auto ends = std::minmax({o[other_side], o[(other_side + 1) % 3]});
  std::size_t side = 0;
  while (side < 2 && std::minmax({t[side], t[(side + 1) % 3]}) != ends) {
    ++side;
  }
  return side;
}

/// Length of the common edge relative to the mean edge of the two facets.
double relative_length(const TriangleMesh& mesh,
                       std::uint32_t facet,
                       std::uint32_t other,
                       std::size_t side) {
  const double mean = 0.5 * (mean_edge_length(mesh, facet) + mean_edge_length(mesh, other));
  return mean > 0.0 ? edge_length(mesh, facet, side) / mean : 1.0;
}

}  // namespace

FacetGraph make_facet_graph(const TriangleMesh& mesh, const LabelingConfig& config) {
  const double unit = kCostUnit * std::log(config.smooth_equal / config.smooth_different);
  const std::vector<FacetNeighbours> neighbours = facet_neighbours(mesh);
  FacetGraph graph;
  graph.edges_of.assign(mesh.triangles.size(), {-1, -1, -1});
  for (std::uint32_t f = 0; f < neighbours.size(); ++f) {
    for (std::size_t side = 0; side < 3; ++side) {
      if (neighbours[f][side] <= static_cast<std::int32_t>(f)) {
        continue;  // none, or entered from the other facet
      }
      const auto other = static_cast<std::uint32_t>(neighbours[f][side]);
      const auto edge = static_cast<std::int32_t>(graph.edges.size());
      graph.edges_of[f][side] = edge;
      graph.edges_of[other][matching_side(mesh, other, f, side)] = edge;
      const double weight = unit * relative_length(mesh, f, other, side);
      graph.edges.push_back({f, other, static_cast<std::int32_t>(std::lround(weight))});
    }
  }
  return graph;
}

void spread_classes(const FacetGraph& graph, std::vector<ClassIndex>* classes) {
  std::vector<std::uint32_t> queue;
  for (std::uint32_t f = 0; f < classes->size(); ++f) {
    if ((*classes)[f] != kNoClass) {
      queue.push_back(f);
    }
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t f = queue[next];
    for (const std::int32_t edge : graph.edges_of[f]) {
      if (edge >= 0 && (*classes)[graph.other(edge, f)] == kNoClass) {
        (*classes)[graph.other(edge, f)] = (*classes)[f];
        queue.push_back(graph.other(edge, f));
      }
    }
  }
}

}  // namespace facet_mapping
