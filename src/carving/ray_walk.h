// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Walking a segment through the cells of the triangulation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

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
  RayWalk() = default;  ///< done()
  RayWalk(const Triangulation& triangulation, VertexHandle start, const Point& target);

  /// A walk that still has to turn around its start: call advance() while turning(), before
  /// anything else is asked.
  static RayWalk turning_walk(const Triangulation& triangulation,
                              VertexHandle start,
                              const Point& target);
  bool turning() const { return turning_; }

  /// The part of the segment beyond a facet of a finite cell: stands in that cell and goes on
  /// through the facet. done() if the segment does not leave the cell there.
  static RayWalk through(const Triangulation& triangulation,
                         VertexHandle start,
                         const Point& target,
                         CellHandle cell,
                         int facet);

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

  /// Fetch into the cache what the next advance() reads, for walks by turns (see ray_bundle.h): the
  /// cell first, then, once that is there, its far corner. Not to be called once done().
  void fetch_next_cell() const;
  void fetch_next_corner();

 private:
  /// A vertex seen along the segment: shifted along it onto a coordinate plane through the start.
  struct Corner {
    VertexHandle vertex;
    double u;         ///< metres
    double v;         ///< metres
    unsigned before;  ///< 1 if nearer than the target along the main axis, exactly
  };

  void choose_axes();
  void enter_from_vertex(VertexHandle start);
  void find_separating_facet(bool is_first_known);
  void turn_around_start(CellHandle next, VertexHandle apex);
  Corner corner(VertexHandle vertex);
  /// Which way two corners turn around the segment: left if positive, and that is sure if the
  /// absolute value is above doubt_.
  static double turn(const Corner& a, const Corner& b) { return a.u * b.v - a.v * b.u; }
  bool turns_left(const Corner& a, const Corner& b) const;
  bool turns_left_exactly(const Point& a, const Point& b) const;
  int hidden_corner(const Corner& reached) const;
  int hidden_corner_exactly(Corner reached) const;
  VertexHandle next_corner() const;
  void check_target();
  bool sees_inside() const { return is_inside(target_); }
  bool is_inside(const Point& point) const;
  bool crosses_exit(VertexHandle start) const;

  VertexHandle infinite_;
  Point source_;
  Point target_;
  std::array<int, 3> axes_{};       ///< of u, v, w; w: the segment's largest component
  std::array<double, 3> origin_{};  ///< the source along these axes
  double slope_u_ = 0.0;            ///< du / dw along the segment, at most 1 in size
  double slope_v_ = 0.0;            ///< dv / dw along the segment, at most 1 in size
  double direction_ = 1.0;          ///< 1 if w grows along the segment, else -1
  double end_ = 0.0;                ///< direction times the target's w
  double reach_ = 0.0;  ///< largest coordinate of a corner met, relative to the start, metres
  double doubt_ = 0.0;  ///< bound of the rounding error of turn() so far, square metres
  CellHandle cell_;
  std::array<Corner, 3> ring_{};  ///< of the exit facet, counter-clockwise around the segment
  VertexHandle apex_;             ///< the next cell's far corner, if it was asked for before
  int exit_ = -1;
  int turns_ = 0;         ///< around the start, so far
  bool turning_ = false;  ///< the exit facet separates the present cell from the target
  bool at_target_ = false;
  bool done_ = true;
  bool left_hull_ = false;
};

/// Distance from `source` along the segment to the plane of a facet; the facet's points are taken
/// in lexicographic order so that the result does not depend on the cell's vertex order.
double distance_to_facet(CellHandle cell, int facet, const Point& source, const Point& target);

// The functions below run once per cell: they are inline and free of branches that no processor can
// foresee, which cost more than the arithmetic.

/// Index of a neighbour, which must be one.
inline int index_of(CellHandle cell, CellHandle neighbour) {
  return static_cast<int>(cell->neighbor(1) == neighbour) +
         2 * static_cast<int>(cell->neighbor(2) == neighbour) +
         3 * static_cast<int>(cell->neighbor(3) == neighbour);
}

/// Index of a vertex, which must be one of the cell's.
inline int index_of(CellHandle cell, VertexHandle vertex) {
  return static_cast<int>(cell->vertex(1) == vertex) +
         2 * static_cast<int>(cell->vertex(2) == vertex) +
         3 * static_cast<int>(cell->vertex(3) == vertex);
}

// With slopes of at most 1, a corner's u and v are wrong by at most 9 units in the last place of
// its largest coordinate and a cross product of two by 90 of the product of these (2^-53 each),
// hence 1e-14, doubled; the last term covers underflow.
inline RayWalk::Corner RayWalk::corner(VertexHandle vertex) {
  constexpr double kRelativeError = 2e-14;
  constexpr double kUnderflow = 1e-290;
  const double* at = vertex->point().cartesian_begin();
  const double u = at[axes_[0]] - origin_[0];
  const double v = at[axes_[1]] - origin_[1];
  const double w = at[axes_[2]] - origin_[2];
  reach_ = std::max(std::max(reach_, std::abs(u)), std::max(std::abs(v), std::abs(w)));
  doubt_ = kRelativeError * (reach_ * reach_) + kUnderflow;
  return {vertex,
          u - slope_u_ * w,
          v - slope_v_ * w,
          static_cast<unsigned>(direction_ * at[axes_[2]] < end_)};
}

// The new corner lies, seen along the segment, opposite to one side of the ring: that side and the
// new corner are the next exit facet. Returns the ring's corner that is not of it.
inline int RayWalk::hidden_corner(const Corner& reached) const {
  const double first = turn(reached, ring_[0]);
  const double second = turn(reached, ring_[1]);
  const double third = turn(reached, ring_[2]);
  if (!(std::min(std::min(std::abs(first), std::abs(second)), std::abs(third)) > doubt_)) {
    return hidden_corner_exactly(reached);
  }
  constexpr unsigned kHidden = 0x2064;  // two bits for each pattern of right turns: 0 1 2 1 0 0 2 0
  const auto right = [](double turn) { return static_cast<unsigned>(std::signbit(turn)); };
  const unsigned turns = right(first) + 2U * right(second) + 4U * right(third);
  return static_cast<int>((kHidden >> (2U * turns)) & 3U);
}

// The segment leaves through its exit facet between that one's corners, so that mostly the main
// axis alone tells on which side the target lies.
inline void RayWalk::check_target() {
  const unsigned before = ring_[0].before + ring_[1].before + ring_[2].before;
  at_target_ = before != 3 && (before == 0 || sees_inside());
}

inline void RayWalk::fetch_next_cell() const {
  __builtin_prefetch(&*cell_->neighbor(exit_));
}

inline VertexHandle RayWalk::next_corner() const {
  const CellHandle next = cell_->neighbor(exit_);
  return next->vertex(index_of(next, cell_));
}

inline void RayWalk::fetch_next_corner() {
  apex_ = next_corner();
  __builtin_prefetch(apex_->point().cartesian_begin());
}

inline void RayWalk::advance() {
  const CellHandle next = cell_->neighbor(exit_);
  const VertexHandle apex = apex_ != VertexHandle() ? apex_ : next_corner();
  apex_ = VertexHandle();
  if (at_target_ || apex == infinite_) {
    left_hull_ = !at_target_;
    cell_ = at_target_ ? cell_ : next;
    done_ = true;
    turning_ = false;
    return;
  }
  if (turning_) {
    turn_around_start(next, apex);
    return;
  }
  cell_ = next;
  const Corner reached = corner(apex);
  const int hidden = hidden_corner(reached);
  exit_ = index_of(cell_, ring_[hidden].vertex);
  // One by one: compilers copy the whole by way of memory, before its parts have arrived there.
  ring_[hidden].vertex = reached.vertex;
  ring_[hidden].u = reached.u;
  ring_[hidden].v = reached.v;
  ring_[hidden].before = reached.before;
  check_target();
}

}  // namespace facet_mapping::carving
