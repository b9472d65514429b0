// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The exact place, between two pixels, where a rendered class ends, and the mesh edge that owns it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// A point of a mesh edge where a class border crosses the line between two pixels.
struct BorderPoint {
  std::array<std::uint32_t, 2> vertices{};  ///< ends of the edge
  std::array<double, 2> weights{};          ///< barycentric: phi_k at the point
  Eigen::Vector3d point_in_cam = Eigen::Vector3d::Zero();
  double position = 0.0;   ///< along the line, 0 at the first pixel, 1 at the second
  bool occluding = false;  ///< the surface turns away here; else two classes share the edge
};

/// Follows the visible surface of one class in image space, facet by facet, to its end.
class BorderTracer {
 public:
  /// All arguments must outlive the tracer. `neighbours`: facet_neighbours(mesh).
  BorderTracer(const TriangleMesh& mesh,
               const std::vector<FacetNeighbours>& neighbours,
               const View& view);

  /// Walks from pixel `from`, which shows `facet`, straight towards pixel `to` and returns where
  /// the class of `facet` ends: at an edge to a facet of another class, at an edge beyond which the
  /// surface turns away (an occluding contour). Nothing if the class goes on up to `to` (then
  /// something nearer hides it) or the mesh ends: the border of an open mesh is where the
  /// reconstruction ends and not where an object does.
  std::optional<BorderPoint> trace(int facet,
                                   const Eigen::Vector2d& from,
                                   const Eigen::Vector2d& to) const;

 private:
  struct Projected;
  Projected project(int facet) const;

  const TriangleMesh& mesh_;
  const std::vector<FacetNeighbours>& neighbours_;
  const PinholeCamera& camera_;
  Eigen::Isometry3d cam_from_world_;
};

}  // namespace facet_mapping
