// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ids that a vertex keeps as long as it stays where it is, so that unchanged chunks of a mesh that
// is made anew are not sent again.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping {

class VertexIds {
 public:
  /// One id per point, all different: that of the same place in the last call, else a new one.
  std::vector<std::uint32_t> number(const std::vector<Eigen::Vector3d>& points);

 private:
  struct Hash {
    std::size_t operator()(const Eigen::Vector3d& p) const;
  };
  using Ids = std::unordered_map<Eigen::Vector3d, std::uint32_t, Hash>;

  Ids ids_;
  std::uint32_t next_ = 0;
};

}  // namespace facet_mapping
