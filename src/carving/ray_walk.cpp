// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/ray_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping::carving {
namespace {

// Far more cells than meet in any vertex: only a defect could walk in circles.
constexpr int kMaxTurns = 10000000;

Eigen::Vector3d difference(const Point& a, const Point& b) {
  return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}

double coordinate(const Point& point, int axis) {
  return *(point.cartesian_begin() + axis);
}

// The corners of a cell but for `apex`, in the order in which a ray from the apex through their
// facet sees them counter-clockwise (CGAL's cells are positively oriented).
std::array<int, 3> counter_clockwise(int apex) {
  constexpr std::array<std::array<int, 3>, 4> kOrder{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  return kOrder[apex];
}

}  // namespace

RayWalk::RayWalk(const Triangulation& triangulation, VertexHandle start, const Point& target)
    : infinite_(triangulation.infinite_vertex()), source_(start->point()), target_(target) {
  if (source_ == target_) {
    done_ = true;
    return;
  }
  choose_axes();
  enter_from_vertex(start);
}

void RayWalk::choose_axes() {
  const Eigen::Vector3d direction = difference(target_, source_);
  direction.cwiseAbs().maxCoeff(&axis_w_);
  axis_u_ = (axis_w_ + 1) % 3;
  axis_v_ = (axis_w_ + 2) % 3;
  slope_u_ = direction[axis_u_] / direction[axis_w_];
  slope_v_ = direction[axis_v_] / direction[axis_w_];
  forward_ = direction[axis_w_] > 0.0;
}

// Seen along the segment from behind, (u, v) turn as in space; against the main axis they are
// mirrored.
RayWalk::Corner RayWalk::corner(VertexHandle vertex) const {
  const Point& point = vertex->point();
  const double pu = coordinate(point, axis_u_) - coordinate(source_, axis_u_);
  const double pv = coordinate(point, axis_v_) - coordinate(source_, axis_v_);
  const double pw = coordinate(point, axis_w_) - coordinate(source_, axis_w_);
  const double u = pu - slope_u_ * pw;
  const double at = coordinate(point, axis_w_);
  const double end = coordinate(target_, axis_w_);
  return {vertex,
          forward_ ? u : -u,
          pv - slope_v_ * pw,
          std::max({std::abs(pu), std::abs(pv), std::abs(pw)}),
          forward_ ? at < end : at > end};
}

// Sign of det(target - source, a - source, b - source) > 0. With slopes of at most 1, u and v are
// wrong by at most 9 units in the last place of `size` and their cross product by 90 of the product
// of the sizes (2^-53 each), hence 1e-14, doubled; the last term covers underflow.
bool RayWalk::turns_left(const Corner& a, const Corner& b) const {
  constexpr double kRelativeError = 2e-14;
  constexpr double kUnderflow = 1e-290;
  const double cross = a.u * b.v - a.v * b.u;
  if (std::abs(cross) > kRelativeError * a.size * b.size + kUnderflow) {
    return cross > 0.0;
  }
  return turns_left_exactly(a.vertex->point(), b.vertex->point());
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
  if (find_first_cell(start)) {
    exit_ = cell_->index(start);
    check_target();
  } else {
    done_ = true;
  }
}

// Turns around the start vertex: a facet through it that separates the present cell from the target
// is crossed. That ends, as from any one point the cells of a Delaunay triangulation hide each
// other without cycles (Edelsbrunner 1990). False if the segment leaves the convex hull at once.
// (CGAL's incident_cells marks cells: not for threads.)
bool RayWalk::find_first_cell(VertexHandle start) {
  const std::array<int, 3> order = counter_clockwise(cell_->index(start));
  for (int k = 0; k < 3; ++k) {
    ring_[k] = corner(cell_->vertex(order[k]));
  }
  int known = -1;  // ring_[known] -> ring_[known + 1] turns left: the facet that was crossed last
  for (int turns = 0; turns < kMaxTurns; ++turns) {
    int across = 0;
    while (across < 3 && (across == known || turns_left(ring_[across], ring_[(across + 1) % 3]))) {
      ++across;
    }
    if (across == 3) {
      return true;
    }
    const VertexHandle behind = ring_[(across + 2) % 3].vertex;
    const CellHandle next = cell_->neighbor(cell_->index(behind));
    const VertexHandle apex = next->vertex(next->index(cell_));
    if (apex == infinite_) {
      return false;
    }
    ring_ = {ring_[(across + 1) % 3], ring_[across], corner(apex)};
    known = 0;
    cell_ = next;
  }
  throw std::logic_error("ray walk: the cells around a vertex are no Delaunay triangulation");
}

// The segment leaves through its exit facet between that one's corners, so that mostly the main
// axis alone tells on which side the target lies.
void RayWalk::check_target() {
  const int before = static_cast<int>(ring_[0].before) + static_cast<int>(ring_[1].before) +
                     static_cast<int>(ring_[2].before);
  if (before == 3 || before == 0) {
    at_target_ = before == 0;
    return;
  }
  std::array<const Point*, 4> corners{};
  for (int j = 0; j < 4; ++j) {
    corners[j] = &cell_->vertex(j)->point();
  }
  corners[exit_] = &target_;
  at_target_ =
      CGAL::orientation(*corners[0], *corners[1], *corners[2], *corners[3]) != CGAL::NEGATIVE;
}

// The new corner lies, seen along the segment, opposite to one of the ring's three sides: that side
// and the new corner are the facet that the segment leaves through.
void RayWalk::advance() {
  if (at_target_) {
    done_ = true;
    return;
  }
  const CellHandle next = cell_->neighbor(exit_);
  const VertexHandle apex = next->vertex(next->index(cell_));
  if (apex == infinite_) {
    done_ = true;
    return;
  }
  cell_ = next;
  const Corner reached = corner(apex);
  int replaced = 0;
  if (turns_left(reached, ring_[0])) {
    replaced = turns_left(reached, ring_[1]) ? 0 : 2;
  } else {
    replaced = turns_left(reached, ring_[2]) ? 1 : 0;
  }
  exit_ = cell_->index(ring_[replaced].vertex);
  ring_[replaced] = reached;
  check_target();
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
