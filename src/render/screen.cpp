// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/screen.h"

#include <algorithm>
#include <cmath>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

// Positions below 2^25 keep every term of an edge function far inside 64 bits, and differences of
// positions inside 32 bits.
constexpr int kPositionBits = 25;

}  // namespace

Screen::Screen(const PinholeCamera& camera) : camera_(camera) {
  int guard_bits = 1;
  while ((1 << guard_bits) < 2 * std::max(camera.width, camera.height)) {
    ++guard_bits;
  }
  bits_ = kPositionBits - guard_bits;
  scale_ = std::ldexp(1.0, bits_);
  guard_px_ = std::ldexp(1.0, guard_bits) - 1.0;  // one pixel of slack for rounding
}

Screen::Distances Screen::distances(const Eigen::Vector3d& in_cam) const {
  const double z = in_cam.z();
  const double u_times_z = camera_.fx * in_cam.x() + camera_.cx * z;
  const double v_times_z = camera_.fy * in_cam.y() + camera_.cy * z;
  const double guard = guard_px_ * z;
  return {
      z - kNearDepth, guard - u_times_z, guard + u_times_z, guard - v_times_z, guard + v_times_z};
}

ScreenVertex Screen::vertex(const Eigen::Vector3d& in_cam) const {
  ScreenVertex vertex;
  vertex.in_cam = in_cam;
  const Distances distance = distances(in_cam);
  for (std::size_t plane = 0; plane < kClipPlanes; ++plane) {
    vertex.outside |= static_cast<std::uint32_t>(distance[plane] < 0.0) << plane;
  }
  if (vertex.outside == 0) {
    project(&vertex);
  }
  return vertex;
}

std::int32_t Screen::snapped(double pixel) const {
  // Shifted to positive numbers, so that cutting off rounds to the nearest.
  constexpr std::int32_t kShift = 1 << (kPositionBits + 1);
  return static_cast<std::int32_t>(pixel * scale_ + (kShift + 0.5)) - kShift;
}

void Screen::project(ScreenVertex* vertex) const {
  const double inverse_z = 1.0 / vertex->in_cam.z();
  vertex->x = snapped(camera_.fx * vertex->in_cam.x() * inverse_z + camera_.cx);
  vertex->y = snapped(camera_.fy * vertex->in_cam.y() * inverse_z + camera_.cy);
  vertex->inverse_z = static_cast<float>(inverse_z);
}

// Always from the inner to the outer point, so that both facets at an edge get the same crossing.
Eigen::Vector3d Screen::crossing(std::size_t plane,
                                 const Eigen::Vector3d& inside,
                                 const Eigen::Vector3d& outside) const {
  const double from = distances(inside)[plane];
  const double to = distances(outside)[plane];
  Eigen::Vector3d point = inside + from / (from - to) * (outside - inside);
  point.z() = std::max(point.z(), kNearDepth);
  return point;
}

ClippedPolygon Screen::clip_at(std::size_t plane, const ClippedPolygon& polygon) const {
  ClippedPolygon kept;
  const auto keep = [&kept](const Eigen::Vector3d& point) {
    if (kept.size < kept.corners.size()) {
      kept.corners[kept.size++].in_cam = point;
    }
  };
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const Eigen::Vector3d& from = polygon.corners[k].in_cam;
    const Eigen::Vector3d& to = polygon.corners[(k + 1) % polygon.size].in_cam;
    const bool from_inside = distances(from)[plane] >= 0.0;
    const bool to_inside = distances(to)[plane] >= 0.0;
    if (from_inside) {
      keep(from);
    }
    if (from_inside != to_inside) {
      keep(from_inside ? crossing(plane, from, to) : crossing(plane, to, from));
    }
  }
  return kept;
}

ClippedPolygon Screen::clip(const ScreenVertex& a,
                            const ScreenVertex& b,
                            const ScreenVertex& c) const {
  ClippedPolygon polygon;
  polygon.corners[0] = a;
  polygon.corners[1] = b;
  polygon.corners[2] = c;
  polygon.size = 3;
  const std::uint32_t crossed = a.outside | b.outside | c.outside;
  for (std::size_t plane = 0; plane < kClipPlanes; ++plane) {
    if ((crossed & (1U << plane)) != 0) {
      polygon = clip_at(plane, polygon);
    }
  }
  for (std::size_t k = 0; k < polygon.size; ++k) {
    project(&polygon.corners[k]);
  }
  return polygon;
}

}  // namespace facet_mapping
