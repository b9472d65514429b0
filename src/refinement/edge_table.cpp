// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_table.h"

#include <algorithm>

namespace facet_mapping {

EdgeTable::EdgeTable(const TriangleMesh& mesh) : of_facet(mesh.triangles.size()) {
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int side = 0; side < 3; ++side) {
      edges.emplace_back(std::minmax(t[side], t[(side + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (std::size_t f = 0; f < of_facet.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (int side = 0; side < 3; ++side) {
      const std::pair<std::uint32_t, std::uint32_t> key = std::minmax(t[side], t[(side + 1) % 3]);
      const auto found = std::lower_bound(edges.begin(), edges.end(), key);
      of_facet[f][side] = static_cast<std::uint32_t>(found - edges.begin());
    }
  }
}

}  // namespace facet_mapping
