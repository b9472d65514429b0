// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facet that a ray meets first, among those that are drawn.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "facet_mapping/rviz/chunk_geometry.h"

namespace facet_mapping {

using PickRay = Eigen::ParametrizedLine<double, 3>;  ///< metres; the direction has length 1

/// What is drawn, as MeshLook and ClassTable say it.
struct PickFilter {
  std::vector<bool> shown;          ///< by class slot
  std::uint8_t min_confidence = 0;  ///< 0..255
  std::uint8_t min_views = 0;
  bool cull_back_faces = false;
  /// From `eye` (the ray's frame), where an orthographic camera's rays do not begin. Metres.
  double max_distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  /// What is more than `max_height` metres along `up` (length 1, the ray's frame) is not drawn.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double max_height = std::numeric_limits<double>::infinity();
};

struct FacetHit {
  double distance = 0.0;                     ///< from the ray's origin, metres
  std::array<Eigen::Vector3d, 3> corners{};  ///< in the ray's frame
  std::array<std::uint8_t, 4> attributes{};  ///< FacetVertex::facet

  /// (b - a) x (c - a): points to free space.
  Eigen::Vector3d cross() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]); }
};

/// Where the ray enters the box: 0 if it starts inside, nothing if it misses it.
std::optional<double> entry_distance(const PickRay& ray, const Eigen::AlignedBox3d& box);

/// `indices`: three per facet. `origin`: of the vertices' positions in the ray's frame.
std::optional<FacetHit> nearest_facet(const PickRay& ray,
                                      const PickFilter& filter,
                                      const Eigen::Vector3d& origin,
                                      const std::vector<FacetVertex>& vertices,
                                      const std::vector<std::uint32_t>& indices);

}  // namespace facet_mapping
