// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/facet_graph.h"

#include <algorithm>
#include <cmath>

#include "labeling/vertex_votes.h"

namespace facet_mapping {
namespace {

// Keeps sums of costs far inside their type even on a mesh with absurdly unequal edges.
constexpr double kLargestWeight = 1e8;

/// Each shared edge once, from its facet with the smaller index; weights are still missing.
std::vector<double> collect_edges(const TriangleMesh& mesh, FacetGraph* graph) {
  const std::vector<FacetNeighbours> neighbours = facet_neighbours(mesh);
  graph->edges_of.assign(mesh.triangles.size(), {-1, -1, -1});
  std::vector<double> lengths;
  for (std::uint32_t f = 0; f < neighbours.size(); ++f) {
    for (std::size_t side = 0; side < 3; ++side) {
      const std::int32_t other = neighbours[f][side];
      if (other <= static_cast<std::int32_t>(f)) {
        continue;
      }
      const auto g = static_cast<std::uint32_t>(other);
      const Eigen::Vector3d& from = mesh.vertices[mesh.triangles[f][side]];
      const Eigen::Vector3d& to = mesh.vertices[mesh.triangles[f][(side + 1) % 3]];
      const auto edge = static_cast<std::int32_t>(graph->edges.size());
      graph->edges.push_back({f, g, 0});
      lengths.push_back((to - from).norm());
      graph->edges_of[f][side] = edge;
      for (std::size_t back = 0; back < 3; ++back) {
        const Triangle& t = mesh.triangles[g];
        const bool same = (t[back] == mesh.triangles[f][side] &&
                           t[(back + 1) % 3] == mesh.triangles[f][(side + 1) % 3]) ||
                          (t[(back + 1) % 3] == mesh.triangles[f][side] &&
                           t[back] == mesh.triangles[f][(side + 1) % 3]);
        if (same) {
          graph->edges_of[g][back] = edge;
        }
      }
    }
  }
  return lengths;
}

}  // namespace

FacetGraph make_facet_graph(const TriangleMesh& mesh, const LabelingConfig& config) {
  FacetGraph graph;
  const std::vector<double> lengths = collect_edges(mesh, &graph);
  double sum = 0.0;
  for (const double length : lengths) {
    sum += length;
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(lengths.size(), 1));
  const double unit = kCostUnit * std::log(config.smooth_equal / config.smooth_different);
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    const double weight = mean > 0.0 ? unit * lengths[e] / mean : unit;
    graph.edges[e].weight =
        static_cast<std::int32_t>(std::lround(std::min(weight, kLargestWeight)));
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
