// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/free_space.h"

#include <algorithm>
#include <array>
#include <utility>

namespace facet_mapping::carving {

FreeSpaceGrowth::FreeSpaceGrowth(Triangulation* triangulation, std::vector<CellHandle> free_cells)
    : triangulation_(*triangulation), by_weight_(std::move(free_cells)) {}

GrowthStats FreeSpaceGrowth::grow() {
  stats_ = {};
  clear();
  // A cell that touches nothing may start a region of its own; most evidence goes first.
  for (const CellHandle seed : by_weight_) {
    if (!seed->info().in_free_set && can_add(seed)) {
      queue_.push({seed->info().free, seed->info().order, seed});
      grow_single_cells();
    }
  }
  while (add_around_vertices()) {
  }
  return stats_;
}

void FreeSpaceGrowth::clear() {
  stats_.free_cells = by_weight_.size();
  for (const VertexHandle vertex : triangulation_.all_vertex_handles()) {
    vertex->info().free_cells = 0;
  }
  for (const CellHandle cell : triangulation_.all_cell_handles()) {
    cell->info().in_free_set = false;
  }
}

void FreeSpaceGrowth::grow_single_cells() {
  while (!queue_.empty()) {
    const CellHandle cell = queue_.top().cell;
    queue_.pop();
    if (!cell->info().in_free_set && can_add(cell)) {
      set_free(cell, true);
      push_neighbours(cell);
    }
  }
}

void FreeSpaceGrowth::push_neighbours(CellHandle cell) {
  for (int k = 0; k < 4; ++k) {
    const CellHandle next = cell->neighbor(k);
    if (next->info().is_free && !next->info().in_free_set) {
      queue_.push({next->info().free, next->info().order, next});
    }
  }
}

void FreeSpaceGrowth::set_free(CellHandle cell, bool free) {
  if (cell->info().in_free_set == free) {
    return;
  }
  cell->info().in_free_set = free;
  for (int k = 0; k < 4; ++k) {
    VertexInfo& vertex = cell->vertex(k)->info();
    vertex.free_cells = free ? vertex.free_cells + 1 : vertex.free_cells - 1;
  }
  stats_.reached_cells = free ? stats_.reached_cells + 1 : stats_.reached_cells - 1;
}

bool FreeSpaceGrowth::edge_touches_free_set(CellHandle cell, int i, int j) const {
  auto around = triangulation_.incident_cells(cell, i, j);
  const auto first = around;
  do {
    if (around->info().in_free_set) {
      return true;
    }
  } while (++around != first);
  return false;
}

// In the link of each of its vertices the cell is a triangle that joins a disk; the disk stays one
// iff they share a connected, non-empty part of the triangle's border, which comes down to these
// cases.
bool FreeSpaceGrowth::can_add(CellHandle cell) const {
  std::array<int, 4> shared{};
  std::array<int, 4> other{};
  int count = 0;
  for (int k = 0; k < 4; ++k) {
    if (cell->neighbor(k)->info().in_free_set) {
      shared[count++] = k;
    } else {
      other[k - count] = k;
    }
  }
  switch (count) {
    case 0:
      return std::all_of(other.begin(), other.end(), [&](int k) {
        return cell->vertex(k)->info().free_cells == 0;
      });
    case 1:
      return cell->vertex(shared[0])->info().free_cells == 0;
    case 2:
      return !edge_touches_free_set(cell, shared[0], shared[1]);
    default:
      return true;
  }
}

// Cells left over lie where adding any one of them would pinch the surface; all of those around a
// vertex together may not, and may change the genus (Lhuillier & Yu 2013).
bool FreeSpaceGrowth::add_around_vertices() {
  bool added = false;
  for (const CellHandle cell : by_weight_) {
    for (int k = 0; k < 4 && !cell->info().in_free_set; ++k) {
      if (try_add_around(cell->vertex(k))) {
        added = true;
        grow_single_cells();
      }
    }
  }
  return added;
}

bool FreeSpaceGrowth::try_add_around(VertexHandle vertex) {
  std::vector<CellHandle> incident;
  triangulation_.incident_cells(vertex, std::back_inserter(incident));
  incident.erase(std::remove_if(incident.begin(),
                                incident.end(),
                                [](CellHandle cell) {
                                  return !cell->info().is_free || cell->info().in_free_set;
                                }),
                 incident.end());
  std::vector<VertexHandle> touched;
  for (const CellHandle cell : incident) {
    set_free(cell, true);
    for (int k = 0; k < 4; ++k) {
      touched.push_back(cell->vertex(k));
    }
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  const bool manifold = std::all_of(
      touched.begin(), touched.end(), [this](VertexHandle v) { return is_manifold_at(v); });
  for (const CellHandle cell : incident) {
    if (manifold) {
      push_neighbours(cell);
    } else {
      set_free(cell, false);
    }
  }
  return manifold && !incident.empty();
}

// The surface passes a vertex as one fan iff, in the vertex's link (a sphere), both the free cells
// and the others are connected over shared facets: their border is then a single closed curve.
bool FreeSpaceGrowth::is_manifold_at(VertexHandle vertex) const {
  std::vector<CellHandle> incident;
  triangulation_.incident_cells(vertex, std::back_inserter(incident));
  std::sort(incident.begin(), incident.end());
  std::vector<bool> seen(incident.size(), false);
  std::array<int, 2> regions{};
  std::vector<std::size_t> stack;
  for (std::size_t start = 0; start < incident.size(); ++start) {
    if (seen[start]) {
      continue;
    }
    const bool free = incident[start]->info().in_free_set;
    if (++regions[free ? 1 : 0] > 1) {
      return false;
    }
    stack.push_back(start);
    seen[start] = true;
    while (!stack.empty()) {
      const CellHandle cell = incident[stack.back()];
      stack.pop_back();
      for (int k = 0; k < 4; ++k) {
        const CellHandle next = cell->neighbor(k);
        if (cell->vertex(k) == vertex || next->info().in_free_set != free) {
          continue;
        }
        const auto at = std::lower_bound(incident.begin(), incident.end(), next) - incident.begin();
        if (!seen[at]) {
          seen[at] = true;
          stack.push_back(at);
        }
      }
    }
  }
  return true;
}

}  // namespace facet_mapping::carving
