// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of a mesh that add up over its chunks.
#pragma once

#include <cstdint>
#include <map>

#include "facet_mapping/mapping/chunked_mesh.h"

namespace facet_mapping {

struct MeshTotals {
  std::uint64_t facets = 0;
  std::uint64_t vertices = 0;     ///< of chunks: one on a border counts in each chunk that has it
  std::uint64_t rated = 0;        ///< labelled facets with a confidence
  double confidence = 0.0;        ///< sum over those
  std::map<Label, double> areas;  ///< square metres per class

  MeshTotals& operator+=(const MeshTotals& other);
};

MeshTotals totals_of(const TriangleMesh& mesh);
MeshTotals totals_of(const MeshChunk& chunk);

}  // namespace facet_mapping
