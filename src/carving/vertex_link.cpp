// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/vertex_link.h"

#include <algorithm>
#include <iterator>

namespace facet_mapping::carving {

void VertexLink::visit(const Triangulation& triangulation, VertexHandle vertex) {
  std::vector<CellHandle> incident;
  incident.reserve(32);
  triangulation.incident_cells(vertex, std::back_inserter(incident));
  for (std::size_t k = 0; k < incident.size(); ++k) {
    incident[k]->info().order = static_cast<std::uint32_t>(k);
  }
  cells_.resize(incident.size());
  for (std::size_t k = 0; k < incident.size(); ++k) {
    const int apex = incident[k]->index(vertex);
    Cell& cell = cells_[k];
    cell.handle = incident[k];
    cell.region = -1;
    cell.free = incident[k]->info().in_free_set;
    for (int j = 0; j < 3; ++j) {
      cell.next[j] = static_cast<int>(incident[k]->neighbor((apex + 1 + j) & 3)->info().order);
    }
  }
  free_regions_ = 0;
  other_regions_ = 0;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (cells_[k].region < 0) {
      flood(k, cells_[k].free ? free_regions_++ : other_regions_++);
    }
  }
}

void VertexLink::flood(std::size_t start, int region) {
  cells_[start].region = region;
  stack_.push_back(start);
  while (!stack_.empty()) {
    const Cell& cell = cells_[stack_.back()];
    stack_.pop_back();
    for (const int next : cell.next) {
      if (cells_[next].region < 0 && cells_[next].free == cell.free) {
        cells_[next].region = region;
        stack_.push_back(next);
      }
    }
  }
}

std::vector<CellHandle> VertexLink::cells_to_take_out() const {
  return free_regions_ > 1 ? small_free_regions() : shortest_chain();
}

std::vector<CellHandle> VertexLink::small_free_regions() const {
  std::vector<std::uint64_t> evidence(free_regions_, 0);
  for (const Cell& cell : cells_) {
    if (cell.free) {
      evidence[cell.region] += cell.handle->info().free + 1U;
    }
  }
  const auto keep =
      static_cast<int>(std::max_element(evidence.begin(), evidence.end()) - evidence.begin());
  std::vector<CellHandle> cells;
  for (const Cell& cell : cells_) {
    if (cell.free && cell.region != keep) {
      cells.push_back(cell.handle);
    }
  }
  return cells;
}

bool VertexLink::touches_other(const Cell& cell, int region, bool same) const {
  return std::any_of(cell.next.begin(), cell.next.end(), [&](int next) {
    return !cells_[next].free && (cells_[next].region == region) == same;
  });
}

// Breadth first, from the free cells beside region 0 to the first beside another region.
std::vector<CellHandle> VertexLink::shortest_chain() const {
  constexpr int kUnseen = -2;
  constexpr int kStart = -1;
  std::vector<int> from(cells_.size(), kUnseen);
  std::vector<int> queue;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (cells_[k].free && touches_other(cells_[k], 0, true)) {
      from[k] = kStart;
      queue.push_back(static_cast<int>(k));
    }
  }
  for (std::size_t at = 0; at < queue.size(); ++at) {
    const Cell& cell = cells_[queue[at]];
    if (touches_other(cell, 0, false)) {
      std::vector<CellHandle> chain;
      for (int k = queue[at]; k != kStart; k = from[k]) {
        chain.push_back(cells_[k].handle);
      }
      return chain;
    }
    for (const int next : cell.next) {
      if (cells_[next].free && from[next] == kUnseen) {
        from[next] = queue[at];
        queue.push_back(next);
      }
    }
  }
  return {};
}

}  // namespace facet_mapping::carving
