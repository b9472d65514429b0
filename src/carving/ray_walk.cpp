// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/ray_walk.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping::carving {
namespace {

// Far more cells than meet in any vertex: only a defect could turn in circles.
constexpr int kMaxTurns = 1000000;

Eigen::Vector3d difference(const Point& a, const Point& b) {
  return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}

// The corners of a cell but for `apex`, in the order in which a ray from the apex through their
// facet sees them counter-clockwise (CGAL's cells are positively oriented).
std::array<int, 3> counter_clockwise(int apex) {
  constexpr std::array<std::array<int, 3>, 4> kOrder{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  return kOrder[apex];
}

}  // namespace

RayWalk::RayWalk(const Triangulation& triangulation, VertexHandle start, const Point& target) {
  *this = turning_walk(triangulation, start, target);
  while (turning_) {
    advance();
  }
}

RayWalk RayWalk::turning_walk(const Triangulation& triangulation,
                              VertexHandle start,
                              const Point& target) {
  RayWalk walk;
  walk.infinite_ = triangulation.infinite_vertex();
  walk.source_ = start->point();
  walk.target_ = target;
  if (walk.source_ != target) {
    walk.choose_axes();
    walk.enter_from_vertex(start);
  }
  return walk;
}

void RayWalk::choose_axes() {
  const Eigen::Vector3d direction = difference(target_, source_);
  int main_axis = 0;
  direction.cwiseAbs().maxCoeff(&main_axis);
  axes_ = {(main_axis + 1) % 3, (main_axis + 2) % 3, main_axis};
  direction_ = direction[main_axis] > 0.0 ? 1.0 : -1.0;
  if (direction_ < 0.0) {
    std::swap(axes_[0], axes_[1]);  // seen against the main axis, space is mirrored
  }
  for (int k = 0; k < 3; ++k) {
    origin_[k] = source_[axes_[k]];
  }
  slope_u_ = direction[axes_[0]] / direction[main_axis];
  slope_v_ = direction[axes_[1]] / direction[main_axis];
  end_ = direction_ * target_[main_axis];
}

bool RayWalk::turns_left(const Corner& a, const Corner& b) const {
  const double quick = turn(a, b);
  return std::abs(quick) > doubt_ ? quick > 0.0
                                  : turns_left_exactly(a.vertex->point(), b.vertex->point());
}

int RayWalk::hidden_corner_exactly(Corner reached) const {
  if (turns_left(reached, ring_[0])) {
    return turns_left(reached, ring_[1]) ? 0 : 2;
  }
  return turns_left(reached, ring_[2]) ? 1 : 0;
}

// In the plane of the segment the determinant of the far end's shift by (e, e^2, e^3) decides: its
// terms are the turns of (source, a, b) in the coordinate planes. Where these vanish too, the three
// points lie on a line and no cell's facet asks.
bool RayWalk::turns_left_exactly(const Point& a, const Point& b) const {
  const CGAL::Orientation side = CGAL::orientation(source_, target_, a, b);
  if (side != CGAL::COPLANAR) {
    return side == CGAL::POSITIVE;
  }
  const auto turn = [&](int first, int second) {
    const auto flat = [&](const Point& p) { return Kernel::Point_2(p[first], p[second]); };
    return CGAL::orientation(flat(source_), flat(a), flat(b));
  };
  for (const auto& [first, second] : {std::pair(1, 2), std::pair(2, 0), std::pair(0, 1)}) {
    const CGAL::Orientation shifted = turn(first, second);
    if (shifted != CGAL::COLLINEAR) {
      return shifted == CGAL::LEFT_TURN;
    }
  }
  return false;
}

void RayWalk::enter_from_vertex(VertexHandle start) {
  cell_ = start->cell();
  int infinite_index = 0;
  while (cell_->has_vertex(infinite_, infinite_index)) {
    cell_ = cell_->neighbor(infinite_index);
  }
  const std::array<int, 3> order = counter_clockwise(cell_->index(start));
  for (int k = 0; k < 3; ++k) {
    ring_[k] = corner(cell_->vertex(order[k]));
  }
  done_ = false;
  find_separating_facet(false);
}

// Of the cell's facets through the start, ring_[k] -> ring_[k + 1], one that separates the cell
// from the target is the way to turn; without one, the segment runs through the facet opposite.
void RayWalk::find_separating_facet(bool is_first_known) {
  for (int k = is_first_known ? 1 : 0; k < 3; ++k) {
    if (!turns_left(ring_[k], ring_[(k + 1) % 3])) {
      const int behind = (k + 2) % 3;
      exit_ = index_of(cell_, ring_[behind].vertex);
      ring_ = {ring_[(k + 1) % 3], ring_[k], ring_[behind]};
      turning_ = true;
      return;
    }
  }
  turning_ = false;
  // The fourth vertex is the start.
  exit_ = 6 - index_of(cell_, ring_[0].vertex) - index_of(cell_, ring_[1].vertex) -
          index_of(cell_, ring_[2].vertex);
  check_target();
}

// Goes on through the facet of ring_[0] and ring_[1], which is known not to separate the next cell.
// That ends, as from any one point the cells of a Delaunay triangulation hide each other without
// cycles (Edelsbrunner 1990). (CGAL's incident_cells marks cells: not for threads.)
void RayWalk::turn_around_start(CellHandle next, VertexHandle apex) {
  if (++turns_ > kMaxTurns) {
    throw std::logic_error("ray walk: the cells around a vertex are no Delaunay triangulation");
  }
  cell_ = next;
  ring_[2] = corner(apex);
  find_separating_facet(true);
}

RayWalk RayWalk::through(const Triangulation& triangulation,
                         VertexHandle start,
                         const Point& target,
                         CellHandle cell,
                         int facet) {
  RayWalk walk;
  walk.infinite_ = triangulation.infinite_vertex();
  walk.source_ = start->point();
  walk.target_ = target;
  walk.cell_ = cell;
  walk.exit_ = facet;
  if (walk.source_ == target) {
    return walk;
  }
  walk.choose_axes();
  const std::array<int, 3> order = counter_clockwise(facet);
  for (int k = 0; k < 3; ++k) {
    walk.ring_[k] = walk.corner(cell->vertex(order[k]));
  }
  walk.done_ = !walk.crosses_exit(start);
  return walk;
}

bool RayWalk::crosses_exit(VertexHandle start) const {
  for (int k = 0; k < 3; ++k) {
    if (ring_[k].vertex == start || !turns_left(ring_[k], ring_[(k + 1) % 3])) {
      return false;
    }
  }
  return is_inside(source_) && !sees_inside();
}

// True if a point lies on the inner side of the exit facet, or on its plane.
bool RayWalk::is_inside(const Point& point) const {
  std::array<const Point*, 4> corners{};
  for (int j = 0; j < 4; ++j) {
    corners[j] = &cell_->vertex(j)->point();
  }
  corners[exit_] = &point;
  return CGAL::orientation(*corners[0], *corners[1], *corners[2], *corners[3]) != CGAL::NEGATIVE;
}

double distance_to_facet(CellHandle cell, int facet, const Point& source, const Point& target) {
  std::array<Point, 3> corners{cell->vertex((facet + 1) & 3)->point(),
                               cell->vertex((facet + 2) & 3)->point(),
                               cell->vertex((facet + 3) & 3)->point()};
  std::sort(corners.begin(), corners.end());
  const Eigen::Vector3d normal =
      difference(corners[1], corners[0]).cross(difference(corners[2], corners[0]));
  const Eigen::Vector3d direction = difference(target, source).normalized();
  const double slope = normal.dot(direction);
  return slope == 0.0 ? 0.0 : std::abs(normal.dot(difference(corners[0], source)) / slope);
}

}  // namespace facet_mapping::carving
