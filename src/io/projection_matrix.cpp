// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection_matrix.h"

#include <cmath>

#include <Eigen/LU>
#include <Eigen/QR>

namespace facet_mapping {

std::optional<ProjectionParts> decompose_projection(const Eigen::Matrix<double, 3, 4>& projection) {
  constexpr double kSingular = 1e-9;
  const Eigen::Matrix3d left = projection.leftCols<3>();
  const double determinant = left.determinant();
  const double volume = left.row(0).norm() * left.row(1).norm() * left.row(2).norm();
  if (!(std::abs(determinant) > kSingular * volume)) {
    return std::nullopt;
  }
  // P is known up to a factor; this one makes K's last entry 1 and R a rotation, no reflection.
  const double factor = (determinant > 0.0 ? 1.0 : -1.0) / left.row(2).norm();
  // (K R)^-1 = R^T K^-1 is a QR decomposition, whose signs are free: K's diagonal is positive.
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr((factor * left).inverse());
  const Eigen::Matrix3d upper = qr.matrixQR().triangularView<Eigen::Upper>();
  const Eigen::Vector3d signs = upper.diagonal().cwiseSign();
  const Eigen::Matrix3d world_from_cam = Eigen::Matrix3d(qr.householderQ()) * signs.asDiagonal();
  const Eigen::Matrix3d inverse_intrinsics = signs.asDiagonal() * upper;
  ProjectionParts parts;
  parts.intrinsics = inverse_intrinsics.inverse();
  parts.intrinsics /= parts.intrinsics(2, 2);
  parts.cam_from_world.setIdentity();
  parts.cam_from_world.linear() = world_from_cam.transpose();
  parts.cam_from_world.translation() = inverse_intrinsics * (factor * projection.col(3));
  return parts;
}

}  // namespace facet_mapping
