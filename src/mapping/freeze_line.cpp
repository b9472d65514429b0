// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/freeze_line.h"

#include <algorithm>

namespace facet_mapping {

bool is_outside_between(const FreezeLine& a, const FreezeLine& b, const Eigen::AlignedBox3d& box) {
  const double radius_m = std::max(a.radius_m, b.radius_m);
  if (!std::isfinite(radius_m)) {
    return false;
  }
  const auto distance = [&](double t) {
    return box.exteriorDistance(Eigen::Vector3d(a.center + t * (b.center - a.center)));
  };
  // The distance to a convex body is convex along a line: thirds close in on its minimum.
  double low = 0.0;
  double high = 1.0;
  constexpr int kSteps = 40;
  for (int step = 0; step < kSteps; ++step) {
    const double left = low + (high - low) / 3.0;
    const double right = high - (high - low) / 3.0;
    (distance(left) <= distance(right) ? high : low) =
        distance(left) <= distance(right) ? right : left;
  }
  return std::min({distance(0.0), distance(1.0), distance(low)}) > radius_m;
}

}  // namespace facet_mapping
