// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/mesh_totals.h"

namespace facet_mapping {

MeshTotals& MeshTotals::operator+=(const MeshTotals& other) {
  facets += other.facets;
  vertices += other.vertices;
  rated += other.rated;
  confidence += other.confidence;
  for (const auto& [label, area] : other.areas) {
    areas[label] += area;
  }
  return *this;
}

MeshTotals totals_of(const TriangleMesh& mesh) {
  MeshTotals totals;
  totals.facets = mesh.triangles.size();
  totals.vertices = mesh.vertices.size();
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Label label = mesh.labels.empty() ? kUnlabelled : mesh.labels[f];
    totals.areas[label] += 0.5 * facet_cross(mesh, f).norm();
    if (label != kUnlabelled && !mesh.confidence.empty()) {
      totals.confidence += static_cast<double>(mesh.confidence[f]);
      ++totals.rated;
    }
  }
  return totals;
}

MeshTotals totals_of(const MeshChunk& chunk) {
  return totals_of(assemble({&chunk}));
}

}  // namespace facet_mapping
