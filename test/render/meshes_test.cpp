// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/meshes.h"

#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

void expect_closed_and_outward(const TriangleMesh& mesh) {
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold()) << check_manifold(mesh).to_string();
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    EXPECT_GT(facet_cross(mesh, f).dot(mesh.vertices[mesh.triangles[f][0]]), 0.0);
  }
}

TEST(TestMeshes, ClosedOnesAreClosedAndFaceOutward) {
  expect_closed_and_outward(test::make_uv_sphere(2.0, 8, 12));
  expect_closed_and_outward(test::make_sphere(2.0, 3));
  expect_closed_and_outward(test::make_box({1.0, 2.0, 3.0}, 2));
}

TEST(TestMeshes, PlaneFacesUpAndBoxFacesComeInOrder) {
  const TriangleMesh plane = test::make_grid_plane(4, 3, 0.5);
  EXPECT_EQ(plane.triangles.size(), 24U);
  EXPECT_GT(facet_cross(plane, 5).z(), 0.0);
  const TriangleMesh box = test::make_box({1.0, 1.0, 1.0}, 2);
  const std::size_t per_face = box.triangles.size() / 6;
  for (std::size_t f = 0; f < box.triangles.size(); ++f) {
    const std::size_t face = f / per_face;
    const Eigen::Vector3d normal = facet_cross(box, f).normalized();
    EXPECT_NEAR(normal[static_cast<int>(face / 2)], face % 2 == 0 ? -1.0 : 1.0, 1e-12);
  }
}

TEST(TestMeshes, LookAtKeepsTheTargetInTheMiddle) {
  const View view = test::look_at(test::make_camera(64, 48, 50.0), {3.0, -2.0, 1.0}, {0, 0, 0});
  EXPECT_TRUE(is_rigid(view.world_from_cam, 1e-9));
  const Eigen::Vector3d target = view.cam_from_world() * Eigen::Vector3d::Zero();
  EXPECT_NEAR((view.camera.project(target) - Eigen::Vector2d(31.5, 23.5)).norm(), 0.0, 1e-9);
  const Eigen::Vector3d above = view.cam_from_world() * Eigen::Vector3d(0.0, 0.0, 0.5);
  EXPECT_LT(view.camera.project(above).y(), 23.5);
}

}  // namespace
}  // namespace facet_mapping
