// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the pixels of one view through the mesh to another view.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/surface_view.h"
#include "facet_mapping/refinement/visible_point.h"

namespace facet_mapping {

/// Where the surface point at a pixel of view i lies in view j.
struct WarpedPoint {
  Eigen::Vector2d pixel;   ///< P_j(x)
  Eigen::Vector2d motion;  ///< change of P_j(x), pixels per metre that the surface moves along n
};

class SurfaceWarp {
 public:
  /// All arguments must outlive the warp. `normals`: facet_normals(mesh).
  SurfaceWarp(const TriangleMesh& mesh,
              const std::vector<Eigen::Vector3d>& normals,
              const View& view_i,
              const SurfaceView& surface_i,
              const View& view_j,
              const SurfaceView& surface_j);

  /// Nothing where the surface is not trusted in i or not seen in j. The point is that where the
  /// pixel's ray meets the plane of its facet, not the rendered depth, which is rounded.
  std::optional<WarpedPoint> at(int x, int y) const;

 private:
  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& normals_;
  const SurfaceView& surface_i_;
  const PinholeCamera& camera_i_;
  const PinholeCamera& camera_j_;
  VisiblePoint visible_in_j_;
  Eigen::Isometry3d j_from_i_;
  Eigen::Matrix3d i_from_world_;
  Eigen::Vector3d center_i_;
};

}  // namespace facet_mapping
