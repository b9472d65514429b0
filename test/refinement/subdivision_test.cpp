// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/subdivision.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/meshes.h"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

double total_area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    sum += 0.5 * facet_cross(mesh, f).norm();
  }
  return sum;
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = M_PI;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
      const Eigen::Vector3d b = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return smallest;
}

/// Pixels proportional to area, large on one side of the mesh only.
std::vector<double> one_sided_pixels(const TriangleMesh& mesh) {
  std::vector<double> pixels;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const bool seen = mesh.vertices[mesh.triangles[f][0]].x() > 0.2;
    pixels.push_back(seen ? 1e4 * facet_cross(mesh, f).norm() : 0.0);
  }
  return pixels;
}

TEST(Subdivision, KeepsAClosedManifoldAndItsShape) {
  const TriangleMesh sphere = test::make_sphere(1.0, 3);
  const TriangleMesh finer = subdivide(sphere, one_sided_pixels(sphere), 20.0);
  const ManifoldReport report = check_manifold(finer);
  EXPECT_TRUE(report.is_closed_manifold()) << report.to_string();
  EXPECT_GT(finer.triangles.size(), 2 * sphere.triangles.size());
  EXPECT_NEAR(total_area(finer), total_area(sphere), 1e-9);
  EXPECT_GT(smallest_angle(finer), 0.45 * smallest_angle(sphere));
}

TEST(Subdivision, LeavesNoFacetAboveTheLimit) {
  const TriangleMesh sphere = test::make_sphere(1.0, 2);
  const auto pixels_by_area = [](const TriangleMesh& mesh) {
    std::vector<double> pixels;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      pixels.push_back(1e4 * facet_cross(mesh, f).norm());
    }
    return pixels;
  };
  constexpr double kLimit = 15.0;
  const std::vector<double> before = pixels_by_area(sphere);
  EXPECT_GT(*std::max_element(before.begin(), before.end()), 10.0 * kLimit);
  const std::vector<double> after = pixels_by_area(subdivide(sphere, before, kLimit));
  EXPECT_LE(*std::max_element(after.begin(), after.end()), kLimit * (1.0 + 1e-9));
  EXPECT_GT(*std::max_element(after.begin(), after.end()), 0.2 * kLimit);
}

TEST(Subdivision, CarriesTheAttributes) {
  TriangleMesh mesh = test::make_box({1.0, 1.0, 1.0}, 1);
  const std::size_t per_face = mesh.triangles.size() / 6;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    mesh.labels.push_back(static_cast<Label>(f / per_face));
    mesh.confidence.push_back(0.1F * static_cast<float>(f / per_face));
    mesh.views.push_back(static_cast<std::uint16_t>(f / per_face));
  }
  std::vector<double> pixels(mesh.triangles.size(), 1.0);
  pixels[3] = 200.0;
  const TriangleMesh finer = subdivide(mesh, pixels, 10.0);
  validate(finer);
  ASSERT_EQ(finer.labels.size(), finer.triangles.size());
  const std::vector<Eigen::Vector3d> normals = facet_normals(finer);
  const std::vector<Eigen::Vector3d> axes = {-Eigen::Vector3d::UnitX(),
                                             Eigen::Vector3d::UnitX(),
                                             -Eigen::Vector3d::UnitY(),
                                             Eigen::Vector3d::UnitY(),
                                             -Eigen::Vector3d::UnitZ(),
                                             Eigen::Vector3d::UnitZ()};
  for (std::size_t f = 0; f < normals.size(); ++f) {
    EXPECT_NEAR((normals[f] - axes[finer.labels[f]]).norm(), 0.0, 1e-9);
    EXPECT_EQ(finer.views[f], finer.labels[f]);
    EXPECT_FLOAT_EQ(finer.confidence[f], 0.1F * static_cast<float>(finer.labels[f]));
  }
}

TEST(Subdivision, DoesNothingBelowTheLimit) {
  const TriangleMesh sphere = test::make_sphere(1.0, 2);
  const std::vector<double> pixels(sphere.triangles.size(), 9.0);
  const TriangleMesh same = subdivide(sphere, pixels, 10.0);
  EXPECT_EQ(same.triangles, sphere.triangles);
  EXPECT_EQ(same.vertices, sphere.vertices);
}

TEST(Subdivision, WorksOnOpenMeshes) {
  const TriangleMesh plane = test::make_grid_plane(3, 3, 1.0);
  const TriangleMesh finer =
      subdivide(plane, std::vector<double>(plane.triangles.size(), 33.0), 10.0);
  const ManifoldReport report = check_manifold(finer);
  EXPECT_EQ(report.non_manifold_edges + report.misoriented_edges + report.non_manifold_vertices,
            0U);
  EXPECT_NEAR(total_area(finer), 9.0, 1e-9);
}

TEST(Subdivision, CountsThePixelsOfTheBestView) {
  const TriangleMesh plane = test::make_grid_plane(1, 1, 1.0);
  const PinholeCamera camera = test::make_camera(100, 100, 100.0);
  const std::vector<View> views = {test::look_at(camera, {0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}),
                                   test::look_at(camera, {0.0, 0.0, 4.0}, {0.0, 0.0, 0.0})};
  const std::vector<double> pixels = best_view_pixels(plane, render_surfaces(plane, views, 0.1));
  EXPECT_NEAR(pixels[0], 1250.0, 80.0);
  EXPECT_NEAR(pixels[0] + pixels[1], 2500.0, 1.0);
}

TEST(Subdivision, RefusesWrongArguments) {
  const TriangleMesh plane = test::make_grid_plane(3, 3, 1.0);
  EXPECT_THROW(subdivide(plane, {1.0}, 10.0), std::invalid_argument);
  const std::vector<double> pixels(plane.triangles.size(), 1.0);
  EXPECT_THROW(subdivide(plane, pixels, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
