// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/camera.h"

#include <cmath>

namespace facet_mapping {

bool PinholeCamera::is_valid() const {
  return width > 0 && height > 0 && std::isfinite(fx) && fx > 0.0 && std::isfinite(fy) &&
         fy > 0.0 && std::isfinite(cx) && std::isfinite(cy);
}

Eigen::Vector2d PinholeCamera::project(const Eigen::Vector3d& point_in_cam) const {
  const double inverse_z = 1.0 / point_in_cam.z();
  return {fx * point_in_cam.x() * inverse_z + cx, fy * point_in_cam.y() * inverse_z + cy};
}

Eigen::Matrix<double, 2, 3> PinholeCamera::projection_jacobian(
    const Eigen::Vector3d& point_in_cam) const {
  const double inverse_z = 1.0 / point_in_cam.z();
  const double x = point_in_cam.x() * inverse_z;
  const double y = point_in_cam.y() * inverse_z;
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << fx * inverse_z, 0.0, -fx * x * inverse_z,  //
      0.0, fy * inverse_z, -fy * y * inverse_z;
  return jacobian;
}

Eigen::Vector3d PinholeCamera::ray(const Eigen::Vector2d& pixel) const {
  return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0};
}

bool PinholeCamera::contains(const Eigen::Vector2d& pixel, double border) const {
  return pixel.x() >= border && pixel.y() >= border && pixel.x() <= width - 1 - border &&
         pixel.y() <= height - 1 - border;
}

PinholeCamera PinholeCamera::resized(int new_width, int new_height) const {
  const double scale_x = static_cast<double>(new_width) / width;
  const double scale_y = static_cast<double>(new_height) / height;
  PinholeCamera camera;
  camera.width = new_width;
  camera.height = new_height;
  camera.fx = fx * scale_x;
  camera.fy = fy * scale_y;
  camera.cx = (cx + 0.5) * scale_x - 0.5;
  camera.cy = (cy + 0.5) * scale_y - 0.5;
  return camera;
}

bool is_rigid(const Eigen::Isometry3d& transform, double tolerance) {
  if (!transform.matrix().allFinite()) {
    return false;
  }
  const Eigen::Matrix3d rotation = transform.linear();
  const Eigen::Matrix3d residual = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  return residual.cwiseAbs().maxCoeff() <= tolerance && rotation.determinant() > 0.0;
}

}  // namespace facet_mapping
