// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that are the same but for rounding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping {

class PointLookup {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// `points` must outlive the lookup.
  PointLookup(const std::vector<Eigen::Vector3d>& points, double tolerance);

  /// The index of the nearest of the points within the tolerance (of equal ones the first), or
  /// kNone.
  std::uint32_t find(const Eigen::Vector3d& point) const;
  std::size_t bytes() const;  ///< of memory held, about

 private:
  const std::vector<Eigen::Vector3d>& points_;
  double tolerance_;
  double spacing_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

/// What float32 leaves of coordinates as large as these, with room to spare.
double rounding_tolerance(const std::vector<Eigen::Vector3d>& points);

}  // namespace facet_mapping
