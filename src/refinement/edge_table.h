// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The undirected edges of a mesh with ids.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

struct EdgeTable {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  ///< ascending vertex pairs
  /// Edge ids of each facet over its sides (0-1, 1-2, 2-0).
  std::vector<std::array<std::uint32_t, 3>> of_facet;

  explicit EdgeTable(const TriangleMesh& mesh);
};

}  // namespace facet_mapping
