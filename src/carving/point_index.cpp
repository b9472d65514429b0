// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/point_index.h"

#include <algorithm>

namespace facet_mapping::carving {
namespace {

constexpr double kCellsInReaches = 2.0;  ///< so that a search looks into two cells along an axis

}  // namespace

PointIndex::PointIndex(double min_reach_m, double max_reach_m) {
  constexpr double kStep = 4.0;
  for (double reach = min_reach_m; levels_.empty() || reach < kStep * max_reach_m; reach *= kStep) {
    levels_.push_back({kCellsInReaches * std::min(reach, max_reach_m), {}});
  }
}

const PointIndex::Level& PointIndex::level_for(double reach_m) const {
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level].spacing_m < kCellsInReaches * reach_m) {
    ++level;
  }
  return levels_[level];
}

void PointIndex::insert(const Eigen::Vector3d& point, std::uint32_t id) {
  for (Level& level : levels_) {
    level.cells[grid_key(grid_cell(point, level.spacing_m))].push_back({point, id});
  }
}

void PointIndex::erase(const Eigen::Vector3d& point, std::uint32_t id) {
  for (Level& level : levels_) {
    const auto cell = level.cells.find(grid_key(grid_cell(point, level.spacing_m)));
    if (cell == level.cells.end()) {
      continue;
    }
    std::vector<Entry>& entries = cell->second;
    entries.erase(
        std::remove_if(
            entries.begin(), entries.end(), [id](const Entry& entry) { return entry.id == id; }),
        entries.end());
    if (entries.empty()) {
      level.cells.erase(cell);
    }
  }
}

std::size_t PointIndex::bytes() const {
  constexpr std::size_t kNode = 64;  // a hash node with its vector, as the allocator rounds it
  constexpr std::size_t kBlock = 16;
  std::size_t bytes = 0;
  for (const Level& level : levels_) {
    bytes += level.cells.bucket_count() * sizeof(void*) + level.cells.size() * kNode;
    for (const auto& [key, entries] : level.cells) {
      bytes += entries.capacity() * sizeof(Entry) + kBlock;
    }
  }
  return bytes;
}

}  // namespace facet_mapping::carving
