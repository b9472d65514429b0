// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The manifold free space: as many free cells as can be had while their boundary is a closed
// 2-manifold (constraint and tests after Litvinov & Lhuillier 2014; Romanoni & Matteucci 2015).
#pragma once

#include <cstddef>
#include <queue>
#include <vector>

#include "carving/triangulation.h"
#include "carving/vertex_link.h"

namespace facet_mapping::carving {

struct GrowthStats {
  std::size_t free_cells = 0;
  std::size_t reached_cells = 0;
};

/// Brings the manifold free space (in_free_set of the cells, free_cells of the vertices) up to
/// date. Around the vertices marked dirty it begins with all free cells, takes out the few that
/// keep the boundary from being a manifold, and grows back what can be had (single cells, then all
/// around a vertex at once, which may change the genus). Growing from one seed, as the paper's
/// predecessors do, leaves several times as many free cells unreached, and cannot be done again for
/// a part.
class FreeSpaceGrowth {
 public:
  explicit FreeSpaceGrowth(Triangulation* triangulation) : triangulation_(*triangulation) {}

  GrowthStats update();

 private:
  struct Candidate {
    Weight free;
    std::uint32_t order;
    CellHandle cell;
    bool operator<(const Candidate& other) const {
      return free != other.free ? free < other.free : order > other.order;
    }
  };

  void take_evidence();
  void mend();
  void mend_at(VertexHandle vertex);
  void take_out(CellHandle cell);
  void grow();
  void grow_single_cells();
  bool can_add(CellHandle cell) const;
  bool edge_touches_free_set(CellHandle cell, int i, int j) const;
  bool try_add_around(VertexHandle vertex);
  void push(CellHandle cell) { queue_.push({cell->info().free, cell->info().order, cell}); }
  void push_neighbours(CellHandle cell);
  GrowthStats count() const;

  Triangulation& triangulation_;
  VertexLink link_;
  std::priority_queue<Candidate> queue_;
  std::vector<VertexHandle> unchecked_;
  std::vector<CellHandle> taken_out_;
};

}  // namespace facet_mapping::carving
