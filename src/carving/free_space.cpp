// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/free_space.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace facet_mapping::carving {

GrowthStats FreeSpaceGrowth::update() {
  taken_out_.clear();
  take_evidence();
  mend();
  grow();
  return count();
}

// A cell that was taken out earlier has its chance again where its surroundings changed.
void FreeSpaceGrowth::take_evidence() {
  for (const CellHandle cell : triangulation_.finite_cell_handles()) {
    const CellInfo& info = cell->info();
    if (info.is_free == info.in_free_set) {
      continue;
    }
    bool is_dirty = info.in_free_set;  // free no longer
    for (int k = 0; k < 4; ++k) {
      is_dirty |= cell->vertex(k)->info().is_dirty;
    }
    if (is_dirty) {
      set_free(cell, info.is_free);
      for (int k = 0; k < 4; ++k) {
        cell->vertex(k)->info().must_check = true;
      }
    }
  }
  for (const VertexHandle vertex : triangulation_.finite_vertex_handles()) {
    VertexInfo& info = vertex->info();
    if (info.is_dirty || info.must_check) {
      unchecked_.push_back(vertex);
    }
    info.is_dirty = false;
    info.must_check = false;
  }
}

// Cells go until the boundary passes every vertex at most once.
void FreeSpaceGrowth::mend() {
  while (!unchecked_.empty()) {
    const VertexHandle vertex = unchecked_.back();
    unchecked_.pop_back();
    if (vertex->info().free_cells > 0) {
      mend_at(vertex);
    }
  }
}

void FreeSpaceGrowth::mend_at(VertexHandle vertex) {
  for (link_.visit(triangulation_, vertex); !link_.is_manifold();
       link_.visit(triangulation_, vertex)) {
    for (const CellHandle cell : link_.cells_to_take_out()) {
      take_out(cell);
    }
  }
}

void FreeSpaceGrowth::take_out(CellHandle cell) {
  set_free(cell, false);
  taken_out_.push_back(cell);
  for (int k = 0; k < 4; ++k) {
    if (!triangulation_.is_infinite(cell->vertex(k))) {
      unchecked_.push_back(cell->vertex(k));
    }
  }
}

// What went for one vertex's sake may be had again now that the others are mended.
void FreeSpaceGrowth::grow() {
  std::uint32_t order = 0;
  for (const CellHandle cell : taken_out_) {
    cell->info().order = order++;
    push(cell);
  }
  grow_single_cells();
  for (const CellHandle cell : taken_out_) {
    for (int k = 0; k < 4 && !cell->info().in_free_set; ++k) {
      if (try_add_around(cell->vertex(k))) {
        grow_single_cells();
      }
    }
  }
}

GrowthStats FreeSpaceGrowth::count() const {
  GrowthStats stats;
  for (const CellHandle cell : triangulation_.finite_cell_handles()) {
    stats.free_cells += cell->info().is_free ? 1 : 0;
    stats.reached_cells += cell->info().in_free_set ? 1 : 0;
  }
  return stats;
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
      push(next);
    }
  }
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

// Adding any one of the cells left over would pinch the surface; all of those around a vertex
// together may not, and may change the genus (Lhuillier & Yu 2013).
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
  const bool manifold = std::all_of(touched.begin(), touched.end(), [this](VertexHandle v) {
    link_.visit(triangulation_, v);
    return link_.is_manifold();
  });
  for (const CellHandle cell : incident) {
    if (manifold) {
      push_neighbours(cell);
    } else {
      set_free(cell, false);
    }
  }
  return manifold && !incident.empty();
}

}  // namespace facet_mapping::carving
