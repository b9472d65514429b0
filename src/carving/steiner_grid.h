// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Extra vertices on a coarse jittered grid that bound the size of cells in empty space.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping::carving {

class SteinerGrid {
 public:
  /// `spacing_m` 0 switches the grid off.
  SteinerGrid(double spacing_m, double reach_m) : spacing_m_(spacing_m), reach_m_(reach_m) {}

  /// The nodes within reach of `center` that were not handed out before. Jitter keeps the nodes in
  /// general position, which the Delaunay triangulation and the ray walk are fastest in.
  std::vector<Eigen::Vector3d> take_around(const Eigen::Vector3d& center);

 private:
  double spacing_m_;
  double reach_m_;
  std::unordered_set<std::uint64_t> taken_;
};

}  // namespace facet_mapping::carving
