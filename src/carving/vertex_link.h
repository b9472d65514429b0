// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What surrounds a vertex: its cells, which cover a sphere, and the free and other regions on it.
#pragma once

#include <cstddef>
#include <vector>

#include "carving/triangulation.h"

namespace facet_mapping::carving {

/// The surface passes the vertex as one fan, or not at all, iff both the free cells and the others
/// are connected over facets at the vertex: their border on the sphere is then one closed curve.
class VertexLink {
 public:
  /// Looks at a vertex; what was learnt of the vertex before is gone.
  void visit(const Triangulation& triangulation, VertexHandle vertex);

  bool is_manifold() const { return free_regions_ <= 1 && other_regions_ <= 1; }

  /// The fewest cells whose removal from the free space takes one step toward is_manifold(): all
  /// free regions but the one with most evidence, or else a shortest chain of free cells between
  /// two of the other regions.
  std::vector<CellHandle> cells_to_take_out() const;

 private:
  struct Cell {
    CellHandle handle;
    std::array<int, 3> next;  ///< indices of the neighbours at the vertex
    int region = -1;
    bool free = false;
  };

  void flood(std::size_t start, int region);
  std::vector<CellHandle> small_free_regions() const;
  std::vector<CellHandle> shortest_chain() const;
  bool touches_other(const Cell& cell, int region, bool same) const;

  std::vector<Cell> cells_;
  std::vector<std::size_t> stack_;
  int free_regions_ = 0;
  int other_regions_ = 0;
};

}  // namespace facet_mapping::carving
