// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/point_index.h"

#include <cmath>

namespace facet_mapping::carving {
namespace {

constexpr int kLevels = 8;

using GridCell = Eigen::Matrix<std::int64_t, 3, 1>;

GridCell grid_cell(const Eigen::Vector3d& point, double spacing_m) {
  return (point / spacing_m).array().floor().cast<std::int64_t>();
}

// 21 bits per axis: unique within two million cells of the origin.
std::uint64_t key(const GridCell& cell) {
  constexpr std::uint64_t kMask = (1ULL << 21U) - 1U;
  return (static_cast<std::uint64_t>(cell.x()) & kMask) |
         (static_cast<std::uint64_t>(cell.y()) & kMask) << 21U |
         (static_cast<std::uint64_t>(cell.z()) & kMask) << 42U;
}

}  // namespace

PointIndex::PointIndex(double min_spacing_m) {
  for (int level = 0; level < kLevels; ++level) {
    levels_.push_back({std::ldexp(min_spacing_m, level), {}});
  }
}

std::int64_t PointIndex::find_near(const Eigen::Vector3d& point, double spacing_m) const {
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level].spacing_m < spacing_m) {
    ++level;
  }
  const Level& grid = levels_[level];
  const GridCell center = grid_cell(point, grid.spacing_m);
  double nearest = grid.spacing_m;
  std::int64_t found = -1;
  for (int k = 0; k < 27; ++k) {
    const GridCell cell = center + GridCell(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const auto entry = grid.cells.find(key(cell));
    if (entry == grid.cells.end()) {
      continue;
    }
    const double distance = (entry->second.point - point).norm();
    if (distance < nearest) {
      nearest = distance;
      found = entry->second.id;
    }
  }
  return found;
}

void PointIndex::insert(const Eigen::Vector3d& point, std::uint32_t id) {
  for (Level& level : levels_) {
    level.cells.try_emplace(key(grid_cell(point, level.spacing_m)), Entry{point, id});
  }
}

}  // namespace facet_mapping::carving
