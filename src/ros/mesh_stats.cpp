// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_stats.h"

#include <map>

namespace facet_mapping {

void fill_mesh_stats(const TriangleMesh& mesh, MeshStats* stats) {
  std::map<Label, double> areas;
  double confidence = 0.0;
  std::size_t labelled = 0;
  stats->facets = mesh.triangles.size();
  stats->vertices = mesh.vertices.size();
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double area = 0.5 * facet_cross(mesh, f).norm();
    const Label label = mesh.labels.empty() ? kUnlabelled : mesh.labels[f];
    areas[label] += area;
    stats->area += area;
    if (label != kUnlabelled && !mesh.confidence.empty()) {
      confidence += static_cast<double>(mesh.confidence[f]);
      ++labelled;
    }
  }
  stats->mean_confidence = labelled == 0 ? 0.0 : confidence / static_cast<double>(labelled);
  for (const auto& [label, area] : areas) {
    stats->class_ids.push_back(label);
    stats->class_areas.push_back(area);
  }
}

}  // namespace facet_mapping
