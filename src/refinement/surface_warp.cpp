// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/surface_warp.h"

namespace facet_mapping {

SurfaceWarp::SurfaceWarp(const TriangleMesh& mesh,
                         const std::vector<Eigen::Vector3d>& normals,
                         const View& view_i,
                         const SurfaceView& surface_i,
                         const View& view_j,
                         const SurfaceView& surface_j)
    : mesh_(mesh),
      normals_(normals),
      surface_i_(surface_i),
      camera_i_(view_i.camera),
      camera_j_(view_j.camera),
      visible_in_j_(view_j, surface_j),
      j_from_i_(view_j.cam_from_world() * view_i.world_from_cam),
      i_from_world_(view_i.world_from_cam.linear().transpose()),
      center_i_(view_i.center()) {}

std::optional<WarpedPoint> SurfaceWarp::at(int x, int y) const {
  if (surface_i_.usable.at<std::uint8_t>(y, x) == 0) {
    return std::nullopt;
  }
  const int facet = surface_i_.image.facets.at<int>(y, x);
  const Eigen::Vector3d& normal = normals_[facet];
  // Distance of the facet's plane from the camera centre: n . d at every pixel of the facet.
  const double distance = normal.dot(mesh_.vertices[mesh_.triangles[facet][0]] - center_i_);
  const Eigen::Vector3d ray = camera_i_.ray({static_cast<double>(x), static_cast<double>(y)});
  const double depth = distance / (i_from_world_ * normal).dot(ray);
  const Eigen::Vector3d d_in_j = j_from_i_.linear() * (depth * ray);
  const Eigen::Vector3d point_in_j = d_in_j + j_from_i_.translation();
  if (!visible_in_j_.sees(point_in_j)) {
    return std::nullopt;
  }
  return WarpedPoint{camera_j_.project(point_in_j),
                     camera_j_.projection_jacobian(point_in_j) * d_in_j / distance};
}

}  // namespace facet_mapping
