// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/mesh_quality.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "edge_table.h"
#include "quality_steps.h"

#include "facet_mapping/geometry/self_intersections.h"

namespace facet_mapping {
namespace {

/// Mean of `values` at both ends of the edges around each vertex; 0 for a vertex without edges.
template <typename EdgeValue>
std::vector<double> mean_over_edges(const EdgeTable& table,
                                    std::size_t vertices,
                                    const EdgeValue& value) {
  std::vector<double> sum(vertices, 0.0);
  std::vector<int> count(vertices, 0);
  for (const auto& [a, b] : table.edges) {
    for (const std::uint32_t v : {a, b}) {
      sum[v] += value(a, b);
      ++count[v];
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    sum[v] /= count[v] > 0 ? count[v] : 1;
  }
  return sum;
}

/// A mesh after the steps and, per facet, which one of the start it was.
struct Improved {
  TriangleMesh mesh;
  std::vector<std::uint32_t> origin;
  QualityReport report;
};

/// Pairs of the start's facets that cross in the improved mesh alone.
std::vector<FacetPair> added_crossings(const TriangleMesh& start, const Improved& improved) {
  const std::vector<std::uint32_t>& origin = improved.origin;
  std::vector<std::uint8_t> changed(origin.size(), 0);
  for (std::size_t f = 0; f < changed.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const bool same = start.vertices[start.triangles[origin[f]][k]] ==
                        improved.mesh.vertices[improved.mesh.triangles[f][k]];
      changed[f] |= same ? 0 : 1;
    }
  }
  std::vector<FacetPair> now = find_self_intersections(improved.mesh, changed);
  for (FacetPair& pair : now) {
    pair = {origin[pair.first], origin[pair.second]};  // ascending still
  }
  const std::vector<FacetPair> known = keep_crossing(start, now);
  std::vector<FacetPair> added;
  std::set_difference(
      now.begin(), now.end(), known.begin(), known.end(), std::back_inserter(added));
  return added;
}

std::vector<double> local_lengths(const TriangleMesh& mesh) {
  const EdgeTable table(mesh);
  const std::size_t count = mesh.vertices.size();
  const std::vector<double> own =
      mean_over_edges(table, count, [&mesh](std::uint32_t a, std::uint32_t b) {
        return (mesh.vertices[a] - mesh.vertices[b]).norm();
      });
  return mean_over_edges(
      table, count, [&own](std::uint32_t a, std::uint32_t b) { return 0.5 * (own[a] + own[b]); });
}

}  // namespace

QualityState::QualityState(const TriangleMesh& mesh,
                           const QualityOptions& quality,
                           const std::vector<std::uint8_t>& may_change)
    : options(quality),
      changeable(may_change),
      editor(mesh),
      local_length(local_lengths(mesh)),
      drift(mesh.triangles.size(), 0.0) {}

bool QualityState::same_region(std::uint32_t f, std::uint32_t g) const {
  const TriangleMesh& mesh = editor.mesh();
  return (mesh.labels.empty() || mesh.labels[f] == mesh.labels[g]) &&
         is_gap(mesh, f) == is_gap(mesh, g);
}

namespace {

Improved run_steps(const TriangleMesh& mesh,
                   const QualityOptions& options,
                   const std::vector<std::uint8_t>& may_change) {
  constexpr int kMaxRounds = 5;  // what is left after two is little
  QualityState state(mesh, options, may_change);
  Improved improved;
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::size_t collapses = collapse_edges(&state);
    const std::size_t flips = flip_edges(&state);
    improved.report.collapses += collapses;
    improved.report.flips += flips;
    if (collapses + flips == 0) {
      break;
    }
  }
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (state.editor.is_alive(f)) {
      improved.origin.push_back(f);
    }
  }
  improved.mesh = std::move(state.editor).take();
  return improved;
}

}  // namespace

TriangleMesh improve_quality(const TriangleMesh& mesh,
                             const QualityOptions& options,
                             QualityReport* report,
                             const std::vector<std::uint8_t>& may_change) {
  validate(mesh);
  if (!may_change.empty() && may_change.size() != mesh.triangles.size()) {
    throw std::invalid_argument("improve_quality: give may_change per facet or not at all");
  }
  std::vector<std::uint8_t> changeable(mesh.triangles.size(), 1);
  if (!may_change.empty()) {
    changeable = may_change;
  }
  constexpr int kMaxTries = 10;  // the second one mostly is the last
  for (int k = 0; k < kMaxTries; ++k) {
    Improved improved = run_steps(mesh, options, changeable);
    const std::vector<FacetPair> added = added_crossings(mesh, improved);
    if (added.empty()) {
      if (report != nullptr) {
        *report = improved.report;
      }
      return std::move(improved.mesh);
    }
    for (const auto& [f, g] : added) {
      changeable[f] = changeable[g] = 0;
    }
  }
  return mesh;
}

}  // namespace facet_mapping
