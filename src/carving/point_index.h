// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which vertex already stands near a point? Hash grids at doubling spacings.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping::carving {

class PointIndex {
 public:
  /// Spacings asked for are rounded up to `min_spacing_m` times a power of two.
  explicit PointIndex(double min_spacing_m);

  /// A vertex within the (rounded) spacing of `point`, or -1. Each grid cell remembers its first
  /// vertex only, so that a near vertex can be missed: this thins, it does not guarantee a
  /// distance.
  std::int64_t find_near(const Eigen::Vector3d& point, double spacing_m) const;
  void insert(const Eigen::Vector3d& point, std::uint32_t id);

 private:
  struct Entry {
    Eigen::Vector3d point;
    std::uint32_t id;
  };
  struct Level {
    double spacing_m;
    std::unordered_map<std::uint64_t, Entry> cells;
  };

  std::vector<Level> levels_;
};

}  // namespace facet_mapping::carving
