// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How a segment meets a cell, decided in rational numbers: slow, and right.
#pragma once

#include <algorithm>
#include <array>

#include "carving/triangulation.h"
#include <CGAL/Exact_rational.h>

namespace facet_mapping::testing {

enum class Meeting {
  kApart,    ///< no common point
  kTouches,  ///< only the cell's boundary
  kCrosses,  ///< the cell's interior
};

/// Rational det(b - a, c - a, d - a).
inline CGAL::Exact_rational exact_volume(const carving::Point& a,
                                         const carving::Point& b,
                                         const carving::Point& c,
                                         const carving::Point& d) {
  using Number = CGAL::Exact_rational;
  std::array<std::array<Number, 3>, 3> m;
  const std::array<const carving::Point*, 3> rows{&b, &c, &d};
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) {
      m[row][k] = Number((*rows[row])[k]) - Number(a[k]);
    }
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// How the closed segment meets a finite cell: it is clipped at the planes of the four facets.
inline Meeting meeting(const carving::Point& source,
                       const carving::Point& target,
                       carving::CellHandle cell) {
  using Number = CGAL::Exact_rational;
  Number begin = 0;
  Number end = 1;
  bool in_plane = false;
  for (int k = 0; k < 4; ++k) {
    std::array<carving::Point, 4> corners;
    for (int j = 0; j < 4; ++j) {
      corners[j] = cell->vertex(j)->point();
    }
    corners[k] = source;
    const CGAL::Orientation source_side =
        CGAL::orientation(corners[0], corners[1], corners[2], corners[3]);
    corners[k] = target;
    const CGAL::Orientation target_side =
        CGAL::orientation(corners[0], corners[1], corners[2], corners[3]);
    if (source_side == CGAL::NEGATIVE && target_side == CGAL::NEGATIVE) {
      return Meeting::kApart;  // the common case, without rational numbers
    }
    if (source_side == CGAL::POSITIVE && target_side == CGAL::POSITIVE) {
      continue;
    }
    corners[k] = source;
    const Number at_source = exact_volume(corners[0], corners[1], corners[2], corners[3]);
    corners[k] = target;
    const Number at_target = exact_volume(corners[0], corners[1], corners[2], corners[3]);
    if (at_source == at_target) {  // both zero
      in_plane = true;
      continue;
    }
    const Number crossing = at_source / (at_source - at_target);
    if (at_source < at_target) {
      begin = std::max(begin, crossing);
    } else {
      end = std::min(end, crossing);
    }
  }
  if (begin > end) {
    return Meeting::kApart;
  }
  return begin == end || in_plane ? Meeting::kTouches : Meeting::kCrosses;
}

}  // namespace facet_mapping::testing
