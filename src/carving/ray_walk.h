// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Walking a segment through the cells of the triangulation.
#pragma once

#include "carving/triangulation.h"
#include <Eigen/Core>

namespace facet_mapping::carving {

/// Visits the cells whose interior the open segment from a vertex to `target` crosses, starting at
/// the vertex. Signs are decided in floating point and, only in doubt, by exact predicates, so that
/// the cells do not depend on how the triangulation came about.
class RayWalk {
 public:
  RayWalk(const Triangulation& triangulation, VertexHandle start, const Point& target);

  /// The present cell; once done(), the last one, or the infinite cell if the segment left the
  /// hull.
  CellHandle cell() const { return cell_; }
  /// True once the segment has left the convex hull: its rest crosses no finite cell.
  bool left_hull() const { return left_hull_; }
  /// True at the end of the segment or where it leaves the convex hull.
  bool done() const { return done_; }
  /// True if the target lies inside the present cell.
  bool at_target() const { return at_target_; }
  /// Index of the facet through which the segment leaves the present cell (toward the target).
  int exit_facet() const { return exit_; }
  void advance();

 private:
  void enter_from_vertex(VertexHandle start);
  void choose_exit(int entry);
  void check_target();
  int separating_facet(int apex) const;
  bool sees_inside(int k) const;
  bool turns_left(const Point& a, const Point& b) const;

  const Triangulation& triangulation_;
  Point source_;
  Point target_;
  Eigen::Vector3d direction_;
  CellHandle cell_;
  int exit_ = -1;
  int steps_ = 0;
  bool at_target_ = false;
  bool done_ = false;
  bool left_hull_ = false;
};

/// Distance from `source` along the segment to the plane of a facet; the facet's points are taken
/// in lexicographic order so that the result does not depend on the cell's vertex order.
double distance_to_facet(CellHandle cell, int facet, const Point& source, const Point& target);

}  // namespace facet_mapping::carving
