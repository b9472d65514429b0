// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Points near a point: hash grids at growing spacings. (That distant cells share a key costs time,
// not correctness.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "carving/grid_key.h"
#include <Eigen/Core>

namespace facet_mapping::carving {

class PointIndex {
 public:
  struct Entry {
    Eigen::Vector3d point;
    std::uint32_t id;
  };

  /// Searches reach at most `max_reach_m`; `min_reach_m` is the finest reach that is worth a grid.
  PointIndex(double min_reach_m, double max_reach_m);

  void insert(const Eigen::Vector3d& point, std::uint32_t id);
  /// Does nothing if it is not there.
  void erase(const Eigen::Vector3d& point, std::uint32_t id);

  /// Calls visit(entry, distance) for all points nearer than `reach_m`, in no defined order.
  template <typename Visit>
  void for_each_near(const Eigen::Vector3d& point, double reach_m, const Visit& visit) const {
    const Level& grid = level_for(reach_m);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach_m);
    const GridCell low = grid_cell(point - margin, grid.spacing_m);
    const GridCell high = grid_cell(point + margin, grid.spacing_m);
    for (std::int64_t x = low.x(); x <= high.x(); ++x) {
      for (std::int64_t y = low.y(); y <= high.y(); ++y) {
        for (std::int64_t z = low.z(); z <= high.z(); ++z) {
          const auto cell = grid.cells.find(grid_key({x, y, z}));
          if (cell == grid.cells.end()) {
            continue;
          }
          for (const Entry& entry : cell->second) {
            const double distance = (entry.point - point).norm();
            if (distance < reach_m) {
              visit(entry, distance);
            }
          }
        }
      }
    }
  }

  std::size_t bytes() const;

 private:
  /// The keys of a surface's cells are far from evenly spread.
  struct Mix {
    std::size_t operator()(std::uint64_t key) const { return (key * 0x9E3779B97F4A7C15ULL) >> 20U; }
  };
  struct Level {
    double spacing_m;
    std::unordered_map<std::uint64_t, std::vector<Entry>, Mix> cells;
  };

  const Level& level_for(double reach_m) const;

  std::vector<Level> levels_;
};

}  // namespace facet_mapping::carving
