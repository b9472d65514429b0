// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Growing the manifold free space: region growing in order of evidence under the constraint that
// its boundary stays a closed 2-manifold (Litvinov & Lhuillier 2014; Romanoni & Matteucci 2015).
#pragma once

#include <cstddef>
#include <queue>
#include <vector>

#include "carving/triangulation.h"

namespace facet_mapping::carving {

struct GrowthStats {
  std::size_t free_cells = 0;
  std::size_t reached_cells = 0;
};

class FreeSpaceGrowth {
 public:
  /// `free_cells`: the cells with is_free set, most evidence first.
  FreeSpaceGrowth(Triangulation* triangulation, std::vector<CellHandle> free_cells);

  /// Sets in_free_set of every cell and free_cells of every vertex.
  GrowthStats grow();

 private:
  struct Candidate {
    Weight free;
    std::uint32_t order;
    CellHandle cell;
    bool operator<(const Candidate& other) const {
      return free != other.free ? free < other.free : order > other.order;
    }
  };

  void clear();
  void grow_single_cells();
  bool add_around_vertices();
  bool can_add(CellHandle cell) const;
  bool edge_touches_free_set(CellHandle cell, int i, int j) const;
  bool try_add_around(VertexHandle vertex);
  bool is_manifold_at(VertexHandle vertex) const;
  void set_free(CellHandle cell, bool free);
  void push_neighbours(CellHandle cell);

  Triangulation& triangulation_;
  std::priority_queue<Candidate> queue_;
  std::vector<CellHandle> by_weight_;  ///< free cells, most evidence first
  GrowthStats stats_;
};

}  // namespace facet_mapping::carving
