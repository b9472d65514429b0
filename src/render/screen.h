// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From camera space to fixed-point screen positions. Positions are snapped to 2^-bits pixels so
// that edge functions are exact integers: shared edges then leave neither holes nor
// double hits. Depth is not snapped, it comes from the facet's plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

struct ScreenVertex {
  Eigen::Vector3d in_cam;     ///< metres
  std::int32_t x = 0;         ///< pixels * 2^bits, set only if `outside` is 0
  std::int32_t y = 0;         ///< pixels * 2^bits, set only if `outside` is 0
  float inverse_z = 0.0F;     ///< 1/metres, set only if `outside` is 0
  std::uint32_t outside = 0;  ///< one bit for each clip plane that the vertex is behind
};

/// The part of a facet that lies inside the clip planes: a convex polygon. Five planes cut a
/// triangle to at most 8 corners; the rest is room for crossings doubled by rounding.
struct ClippedPolygon {
  std::array<ScreenVertex, 12> corners;
  std::size_t size = 0;
};

class Screen {
 public:
  static constexpr std::size_t kClipPlanes = 5;  ///< near, and the guard band's four sides

  explicit Screen(const PinholeCamera& camera);

  ScreenVertex vertex(const Eigen::Vector3d& in_cam) const;
  ClippedPolygon clip(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) const;

  const PinholeCamera& camera() const { return camera_; }
  int bits() const { return bits_; }

 private:
  using Distances = std::array<double, kClipPlanes>;  // times metres; negative is outside

  void project(ScreenVertex* vertex) const;
  std::int32_t snapped(double pixel) const;
  Distances distances(const Eigen::Vector3d& in_cam) const;
  ClippedPolygon clip_at(std::size_t plane, const ClippedPolygon& polygon) const;
  Eigen::Vector3d crossing(std::size_t plane,
                           const Eigen::Vector3d& inside,
                           const Eigen::Vector3d& outside) const;

  PinholeCamera camera_;
  int bits_ = 0;
  double scale_ = 1.0;     // 2^bits
  double guard_px_ = 0.0;  // largest pixel coordinate, either sign
};

}  // namespace facet_mapping
