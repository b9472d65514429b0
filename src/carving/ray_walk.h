// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Walking a segment through the cells of the triangulation.
#pragma once

#include <array>

#include "carving/triangulation.h"

namespace facet_mapping::carving {

/// Visits, in order, the cells whose interior the open segment from a vertex to `target` crosses.
///
/// Signs are decided in floating point and, only in doubt, exactly; where the segment meets an edge
/// or a vertex, or runs in a facet's plane, its far end counts as moved by (e, e^2, e^3) with an
/// infinitely small e. So a run is always a chain of cells that share facets, it holds all cells
/// that the segment crosses and beyond these only ones that it touches, and it depends neither on
/// how the triangulation came about nor on the order in which a cell stores its vertices.
class RayWalk {
 public:
  RayWalk(const Triangulation& triangulation, VertexHandle start, const Point& target);

  /// The present cell; invalid once done().
  CellHandle cell() const { return cell_; }
  /// True at the end of the segment or where it leaves the convex hull.
  bool done() const { return done_; }
  /// True if the target lies inside the present cell.
  bool at_target() const { return at_target_; }
  /// Index of the facet through which the segment leaves the present cell (toward the target).
  int exit_facet() const { return exit_; }
  void advance();

 private:
  /// A vertex seen along the segment: shifted along it onto a coordinate plane through the start.
  struct Corner {
    VertexHandle vertex;
    double u;     ///< metres
    double v;     ///< metres
    double size;  ///< largest coordinate relative to the start, metres: scales the error
    bool before;  ///< nearer than the target along the main axis, exactly
  };

  void choose_axes();
  Corner corner(VertexHandle vertex) const;
  bool turns_left(const Corner& a, const Corner& b) const;
  bool turns_left_exactly(const Point& a, const Point& b) const;
  void enter_from_vertex(VertexHandle start);
  bool find_first_cell(VertexHandle start);
  void check_target();

  VertexHandle infinite_;
  Point source_;
  Point target_;
  int axis_u_ = 0;  ///< the axes are a cyclic turn of x, y, z, so that signs stay
  int axis_v_ = 1;
  int axis_w_ = 2;        ///< the main axis: the segment's largest component
  double slope_u_ = 0.0;  ///< du / dw along the segment
  double slope_v_ = 0.0;  ///< dv / dw along the segment
  bool forward_ = true;   ///< w grows along the segment
  CellHandle cell_;
  std::array<Corner, 3> ring_{};  ///< of the exit facet, counter-clockwise around the segment
  int exit_ = -1;
  bool at_target_ = false;
  bool done_ = false;
};

/// Distance from `source` along the segment to the plane of a facet; the facet's points are taken
/// in lexicographic order so that the result does not depend on the cell's vertex order.
double distance_to_facet(CellHandle cell, int facet, const Point& source, const Point& target);

}  // namespace facet_mapping::carving
