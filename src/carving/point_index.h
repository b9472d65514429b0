// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Points near a point: hash grids at growing spacings.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

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
    const GridCell center = grid_cell(point, grid.spacing_m);
    const auto rings = static_cast<std::int64_t>(std::ceil(reach_m / grid.spacing_m));
    for (std::int64_t x = -rings; x <= rings; ++x) {
      for (std::int64_t y = -rings; y <= rings; ++y) {
        for (std::int64_t z = -rings; z <= rings; ++z) {
          const auto cell = grid.cells.find(key(center + GridCell(x, y, z)));
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
  using GridCell = Eigen::Matrix<std::int64_t, 3, 1>;
  struct Level {
    double spacing_m;
    std::unordered_map<std::uint64_t, std::vector<Entry>> cells;
  };

  const Level& level_for(double reach_m) const;
  static GridCell grid_cell(const Eigen::Vector3d& point, double spacing_m);
  static std::uint64_t key(const GridCell& cell);

  std::vector<Level> levels_;
};

}  // namespace facet_mapping::carving
