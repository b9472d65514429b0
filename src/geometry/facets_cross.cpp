// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facets_cross.h"

#include <algorithm>
#include <array>
#include <cmath>

#ifdef __clang_analyzer__
#define CGAL_DO_NOT_USE_MPZF  // the analyser takes how it keeps its digits for an error
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <Eigen/Geometry>

namespace facet_mapping {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

/// Differences of coordinates are exact to about 1e-16 of themselves: what clears this margin is
/// decided without exact arithmetic, which for nearly flat surfaces would be slow.
constexpr double kMargin = 1e-12;

Point point(const TriangleMesh& mesh, std::uint32_t vertex) {
  const Eigen::Vector3d& v = mesh.vertices[vertex];
  return {v.x(), v.y(), v.z()};
}

Kernel::Triangle_3 triangle(const TriangleMesh& mesh, const Triangle& t) {
  return {point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2])};
}

Kernel::Segment_3 segment(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return {point(mesh, a), point(mesh, b)};
}

/// Facets (v, a, b) and (v, c, d): does a plane through v leave them on two sides?
bool is_parted(const TriangleMesh& mesh, const Triangle& f, const Triangle& g) {
  const Eigen::Vector3d& v = mesh.vertices[f[0]];
  const Eigen::Vector3d a = (mesh.vertices[f[1]] - v).normalized();
  const Eigen::Vector3d b = (mesh.vertices[f[2]] - v).normalized();
  const Eigen::Vector3d c = (mesh.vertices[g[1]] - v).normalized();
  const Eigen::Vector3d d = (mesh.vertices[g[2]] - v).normalized();
  const Eigen::Vector3d across = a + b - c - d;
  return std::min(across.dot(a), across.dot(b)) > kMargin &&
         std::max(across.dot(c), across.dot(d)) < -kMargin;
}

bool cross_at_corner(const TriangleMesh& mesh, const Triangle& f, const Triangle& g) {
  return !is_parted(mesh, f, g) &&
         (CGAL::do_intersect(segment(mesh, f[1], f[2]), triangle(mesh, g)) ||
          CGAL::do_intersect(segment(mesh, g[1], g[2]), triangle(mesh, f)));
}

/// Facets over the edge (v, w) with third corners p and q cross if one is folded onto the other.
bool cross_at_edge(
    const TriangleMesh& mesh, std::uint32_t v, std::uint32_t w, std::uint32_t p, std::uint32_t q) {
  const Eigen::Vector3d edge = (mesh.vertices[w] - mesh.vertices[v]).normalized();
  const Eigen::Vector3d to_p = (mesh.vertices[p] - mesh.vertices[v]).normalized();
  const Eigen::Vector3d to_q = (mesh.vertices[q] - mesh.vertices[v]).normalized();
  const Eigen::Vector3d normal = edge.cross(to_p);
  if (normal.dot(edge.cross(to_q)) < -kMargin || std::abs(normal.dot(to_q)) > kMargin) {
    return false;
  }
  const std::array<Point, 4> x = {point(mesh, v), point(mesh, w), point(mesh, p), point(mesh, q)};
  return CGAL::coplanar(x[0], x[1], x[2], x[3]) &&
         CGAL::coplanar_orientation(x[0], x[1], x[2], x[3]) == CGAL::POSITIVE;
}

/// Brings the corners that `t` shares with `other` to its front; returns how many there are.
std::size_t shared_first(const Triangle& other, Triangle* t) {
  const auto end = std::partition(t->begin(), t->end(), [&other](std::uint32_t v) {
    return v == other[0] || v == other[1] || v == other[2];
  });
  return static_cast<std::size_t>(end - t->begin());
}

}  // namespace

bool is_degenerate(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.triangles[facet];
  return CGAL::collinear(point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2]));
}

bool facets_cross(const TriangleMesh& mesh, std::uint32_t f, std::uint32_t g) {
  Triangle a = mesh.triangles[f];
  Triangle b = mesh.triangles[g];
  const std::size_t shared = shared_first(mesh.triangles[g], &a);
  shared_first(mesh.triangles[f], &b);
  switch (shared) {
    case 0:
      return CGAL::do_intersect(triangle(mesh, a), triangle(mesh, b));
    case 1:
      return cross_at_corner(mesh, a, b);
    case 2:
      return cross_at_edge(mesh, a[0], a[1], a[2], b[2]);
    default:
      return true;
  }
}

}  // namespace facet_mapping
