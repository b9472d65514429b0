// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/ray_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace facet_mapping::carving {
namespace {

// Far more cells than any segment crosses: only a defect could walk in circles.
constexpr int kMaxSteps = 10000000;

Eigen::Vector3d difference(const Point& a, const Point& b) {
  return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}

}  // namespace

RayWalk::RayWalk(const Triangulation& triangulation, VertexHandle start, const Point& target)
    : triangulation_(triangulation),
      source_(start->point()),
      target_(target),
      direction_(difference(target, source_)) {
  enter_from_vertex(start);
}

// Sign of det(target - source, a - source, b - source) > 0.
bool RayWalk::turns_left(const Point& a, const Point& b) const {
  const Eigen::Vector3d u = difference(a, source_);
  const Eigen::Vector3d v = difference(b, source_);
  const double determinant = direction_.dot(u.cross(v));
  // Bound of the rounding error of the determinant (Shewchuk's permanent bound, rounded up); the
  // differences themselves are rounded too, hence the generous factor.
  const Eigen::Vector3d permanent(std::abs(u.y() * v.z()) + std::abs(u.z() * v.y()),
                                  std::abs(u.z() * v.x()) + std::abs(u.x() * v.z()),
                                  std::abs(u.x() * v.y()) + std::abs(u.y() * v.x()));
  constexpr double kRelativeError = 2e-15;
  if (std::abs(determinant) > kRelativeError * direction_.cwiseAbs().dot(permanent)) {
    return determinant > 0.0;
  }
  return CGAL::orientation(source_, target_, a, b) == CGAL::POSITIVE;
}

// Turns around the start vertex toward the target: a facet through the start vertex that separates
// the present cell from the target is crossed. (CGAL's incident_cells marks cells: not for
// threads.)
void RayWalk::enter_from_vertex(VertexHandle start) {
  cell_ = start->cell();
  while (triangulation_.is_infinite(cell_)) {
    cell_ = cell_->neighbor(cell_->index(triangulation_.infinite_vertex()));
  }
  for (steps_ = 0; steps_ < kMaxSteps; ++steps_) {
    const int apex = cell_->index(start);
    const int across = separating_facet(apex);
    if (across < 0) {
      exit_ = apex;
      check_target();
      return;
    }
    cell_ = cell_->neighbor(across);
    if (triangulation_.is_infinite(cell_)) {
      left_hull_ = true;
      break;
    }
  }
  done_ = true;
}

// Which facet is tried first changes from step to step, so that the walk cannot turn in circles.
int RayWalk::separating_facet(int apex) const {
  for (int turn = 1; turn <= 3; ++turn) {
    const int k = (apex + 1 + (turn + steps_ * 7) % 3) & 3;
    if (!sees_inside(k)) {
      return k;
    }
  }
  return -1;
}

// True if the target lies on the inner side of facet k, or on its plane.
bool RayWalk::sees_inside(int k) const {
  std::array<const Point*, 4> corners{};
  for (int j = 0; j < 4; ++j) {
    corners[j] = &cell_->vertex(j)->point();
  }
  corners[k] = &target_;
  return CGAL::orientation(*corners[0], *corners[1], *corners[2], *corners[3]) != CGAL::NEGATIVE;
}

void RayWalk::check_target() {
  at_target_ = sees_inside(exit_);
}

void RayWalk::choose_exit(int entry) {
  const Point& apex = cell_->vertex(entry)->point();
  std::array<int, 3> ring{(entry + 1) & 3, (entry + 2) & 3, (entry + 3) & 3};
  std::array<bool, 3> left{};
  for (int k = 0; k < 3; ++k) {
    left[k] = turns_left(apex, cell_->vertex(ring[k])->point());
  }
  // Seen along the segment, the entry facet surrounds it; the exit facet is the one of the apex and
  // two corners that surrounds it too: the apex turns one way to the first, the other to the
  // second.
  const bool orientation =
      turns_left(cell_->vertex(ring[0])->point(), cell_->vertex(ring[1])->point());
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (left[k] == orientation && left[next] != orientation) {
      exit_ = ring[(k + 2) % 3];
      return;
    }
  }
  exit_ = ring[0];
}

void RayWalk::advance() {
  if (at_target_ || ++steps_ > kMaxSteps) {
    done_ = true;
    return;
  }
  const CellHandle next = cell_->neighbor(exit_);
  const int entry = next->index(cell_);
  cell_ = next;
  if (triangulation_.is_infinite(next)) {
    left_hull_ = true;
    done_ = true;
    return;
  }
  choose_exit(entry);
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
