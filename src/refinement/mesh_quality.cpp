// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/mesh_quality.h"

#include <stdexcept>
#include <utility>

#include "edge_table.h"
#include "quality_steps.h"

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

TriangleMesh improve_quality(const TriangleMesh& mesh,
                             const QualityOptions& options,
                             QualityReport* report,
                             const std::vector<std::uint8_t>& may_change) {
  validate(mesh);
  if (!may_change.empty() && may_change.size() != mesh.triangles.size()) {
    throw std::invalid_argument("improve_quality: give may_change per facet or not at all");
  }
  QualityState state(mesh, options, may_change);
  QualityReport total;
  constexpr int kMaxRounds = 5;  // what is left after two is little
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::size_t collapses = collapse_edges(&state);
    const std::size_t flips = flip_edges(&state);
    total.collapses += collapses;
    total.flips += flips;
    if (collapses + flips == 0) {
      break;
    }
  }
  if (report != nullptr) {
    *report = total;
  }
  return std::move(state.editor).take();
}

}  // namespace facet_mapping
