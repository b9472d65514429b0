// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_lookup.h"

#include <algorithm>
#include <limits>

#include "carving/grid_key.h"

namespace facet_mapping {

using carving::grid_cell;
using carving::grid_key;
using carving::GridCell;

PointLookup::PointLookup(const std::vector<Eigen::Vector3d>& points, double tolerance)
    : points_(points), tolerance_(tolerance), spacing_(4.0 * tolerance) {
  cells_.reserve(points.size());
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    cells_.emplace(grid_key(grid_cell(points[k], spacing_)), k);
  }
}

std::uint32_t PointLookup::find(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(tolerance_);
  const GridCell low = grid_cell(point - reach, spacing_);
  const GridCell high = grid_cell(point + reach, spacing_);
  auto best = std::make_pair(tolerance_ * tolerance_, kNone);
  for (std::int64_t x = low.x(); x <= high.x(); ++x) {
    for (std::int64_t y = low.y(); y <= high.y(); ++y) {
      for (std::int64_t z = low.z(); z <= high.z(); ++z) {
        const auto [begin, end] = cells_.equal_range(grid_key({x, y, z}));
        for (auto it = begin; it != end; ++it) {
          const double squared = (points_[it->second] - point).squaredNorm();
          best = std::min(best, std::make_pair(squared, it->second));
        }
      }
    }
  }
  return best.second;
}

std::size_t PointLookup::bytes() const {
  constexpr std::size_t kNode = 4 * sizeof(void*);
  return cells_.size() * kNode + cells_.bucket_count() * sizeof(void*);
}

double rounding_tolerance(const std::vector<Eigen::Vector3d>& points) {
  constexpr double kShare = 1e-6;
  double largest = std::numeric_limits<double>::min();
  for (const Eigen::Vector3d& p : points) {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  return kShare * largest;
}

}  // namespace facet_mapping
