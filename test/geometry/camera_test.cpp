// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/camera.h"

#include <limits>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

PinholeCamera kitti_camera() {
  PinholeCamera camera;
  camera.width = 1242;
  camera.height = 375;
  camera.fx = 721.5;
  camera.fy = 720.0;
  camera.cx = 609.6;
  camera.cy = 172.9;
  return camera;
}

TEST(PinholeCamera, RayAndProjectionAreInverse) {
  const PinholeCamera camera = kitti_camera();
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1241, 374.5)}) {
    EXPECT_LT((camera.project(7.0 * camera.ray(pixel)) - pixel).norm(), 1e-9);
  }
}

TEST(PinholeCamera, JacobianAgreesWithFiniteDifferences) {
  const PinholeCamera camera = kitti_camera();
  const Eigen::Vector3d point(1.5, -0.7, 9.0);
  const Eigen::Matrix<double, 2, 3> jacobian = camera.projection_jacobian(point);
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector2d numeric =
        (camera.project(point + step) - camera.project(point - step)) / (2.0 * kStep);
    EXPECT_LT((jacobian.col(axis) - numeric).norm(), 1e-4);
  }
}

TEST(PinholeCamera, ResizingKeepsPixelAreas) {
  const PinholeCamera camera = kitti_camera();
  const PinholeCamera half = camera.resized(621, 187);
  // The outer corner of the first pixel stays the outer corner.
  const Eigen::Vector3d corner = camera.ray({-0.5, -0.5});
  EXPECT_LT((half.project(corner) - Eigen::Vector2d(-0.5, -0.5)).norm(), 1e-9);
  const PinholeCamera back = half.resized(1242, 375);
  EXPECT_NEAR(back.cx, camera.cx, 1e-9);
  EXPECT_NEAR(back.fy, camera.fy, 1e-9);
}

TEST(PinholeCamera, KnowsWhetherItIsValid) {
  PinholeCamera camera = kitti_camera();
  EXPECT_TRUE(camera.is_valid());
  camera.fx = 0.0;
  EXPECT_FALSE(camera.is_valid());
  camera = kitti_camera();
  camera.cy = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(camera.is_valid());
  EXPECT_FALSE(PinholeCamera{}.is_valid());
}

TEST(PinholeCamera, ContainsItsPixelCentres) {
  const PinholeCamera camera = kitti_camera();
  EXPECT_TRUE(camera.contains({0.0, 0.0}));
  EXPECT_TRUE(camera.contains({1241.0, 374.0}));
  EXPECT_FALSE(camera.contains({1241.2, 10.0}));
  EXPECT_FALSE(camera.contains({0.5, 10.0}, 1.0));
  EXPECT_FALSE(camera.contains({std::numeric_limits<double>::quiet_NaN(), 10.0}));
}

TEST(IsRigid, TellsRotationsFromOtherMatrices) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  EXPECT_TRUE(is_rigid(pose));
  Eigen::Isometry3d scaled = pose;
  scaled.linear() *= 1.1;
  EXPECT_FALSE(is_rigid(scaled));
  Eigen::Isometry3d mirrored = pose;
  mirrored.linear().col(0) *= -1.0;
  EXPECT_FALSE(is_rigid(mirrored));
  pose.translation().x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_rigid(pose));
}

}  // namespace
}  // namespace facet_mapping
