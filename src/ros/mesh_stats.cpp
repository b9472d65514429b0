// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_stats.h"

namespace facet_mapping {

void fill_mesh_stats(const MeshTotals& totals, MeshStats* stats) {
  stats->facets = totals.facets;
  stats->vertices = totals.vertices;
  stats->mean_confidence =
      totals.rated == 0 ? 0.0 : totals.confidence / static_cast<double>(totals.rated);
  for (const auto& [label, area] : totals.areas) {
    stats->class_ids.push_back(label);
    stats->class_areas.push_back(area);
    stats->area += area;
  }
}

}  // namespace facet_mapping
