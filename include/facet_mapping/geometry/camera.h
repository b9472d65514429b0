// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A rectified pinhole camera and its pose. Camera frame: optical (x right, y down, z forward),
// metres. Pixels: centres at integer coordinates, so that the image covers [-0.5, width - 0.5).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping {

struct PinholeCamera {
  int width = 0;    ///< pixels
  int height = 0;   ///< pixels
  double fx = 0.0;  ///< focal length, pixels
  double fy = 0.0;  ///< focal length, pixels
  double cx = 0.0;  ///< principal point, pixels
  double cy = 0.0;  ///< principal point, pixels

  /// True if the size and the focal lengths are positive and everything is finite.
  bool is_valid() const;

  /// Pixel of a point in the camera frame; the caller makes sure that `point.z() > 0`.
  Eigen::Vector2d project(const Eigen::Vector3d& point_in_cam) const;

  /// d(pixel) / d(point in the camera frame), 2x3, pixels per metre.
  Eigen::Matrix<double, 2, 3> projection_jacobian(const Eigen::Vector3d& point_in_cam) const;

  /// Viewing ray through a pixel in the camera frame, scaled to z = 1.
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;

  /// True if the pixel lies at least `border` pixels inside the outermost pixel centres.
  bool contains(const Eigen::Vector2d& pixel, double border = 0.0) const;

  /// The camera of the same image resampled to `new_width` x `new_height` (pixel areas are kept).
  PinholeCamera resized(int new_width, int new_height) const;
};

/// A camera at a pose in the map.
struct View {
  PinholeCamera camera;
  Eigen::Isometry3d world_from_cam = Eigen::Isometry3d::Identity();

  Eigen::Vector3d center() const { return world_from_cam.translation(); }
  Eigen::Isometry3d cam_from_world() const { return world_from_cam.inverse(Eigen::Isometry); }
};

/// True if every entry is finite and the linear part is a rotation to within `tolerance`.
bool is_rigid(const Eigen::Isometry3d& transform, double tolerance = 1e-3);

}  // namespace facet_mapping
