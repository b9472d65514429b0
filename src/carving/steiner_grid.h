// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Extra vertices on a coarse jittered grid that bound the size of cells in empty space.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "carving/rays.h"
#include <Eigen/Core>

namespace facet_mapping::carving {

/// A node of the grid is wanted while a sensor is within reach of it and no point within clearance:
/// so it depends on what is in the map alone, not on the order in which it came.
class SteinerGrid {
 public:
  /// `spacing_m` 0 switches the grid off.
  SteinerGrid(double spacing_m, double reach_m, double clearance_m)
      : spacing_m_(spacing_m), reach_m_(reach_m), clearance_m_(clearance_m) {}

  void add_sensor(const Eigen::Vector3d& center) { count_sensor(center, 1); }
  void remove_sensor(const Eigen::Vector3d& center) { count_sensor(center, -1); }
  void add_point(const Eigen::Vector3d& point) { count_point(point, 1); }
  void remove_point(const Eigen::Vector3d& point) { count_point(point, -1); }

  struct Wish {
    std::uint64_t key;
    Eigen::Vector3d point;
    SiteId site;  ///< kNoId: to be added; else to be removed
  };
  /// What must be added or removed since the last call, in ascending order of the keys; answer each
  /// wish with set_site().
  std::vector<Wish> take_wishes();
  void set_site(std::uint64_t key, SiteId site);

  /// Forgets the nodes farther than `radius_m` from `center`; returns the sites of those that
  /// stood.
  std::vector<SiteId> forget_beyond(const Eigen::Vector3d& center, double radius_m);

  std::size_t bytes() const;

 private:
  struct Node {
    std::int32_t sensors = 0;  ///< within reach
    std::int32_t points = 0;   ///< within clearance
    SiteId site = kNoId;
    bool touched = false;
  };

  void count_sensor(const Eigen::Vector3d& center, int change);
  void count_point(const Eigen::Vector3d& point, int change);
  void touch(std::uint64_t key, Node* node);
  Eigen::Vector3d position(std::uint64_t key) const;

  double spacing_m_;
  double reach_m_;
  double clearance_m_;
  std::unordered_map<std::uint64_t, Node> nodes_;
  std::vector<std::uint64_t> touched_;
};

}  // namespace facet_mapping::carving
