// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/step.h"

#include <cmath>
#include <random>

#include "support/meshes.h"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

TEST(Step, IsTheQuotientOfGradientAndCurvatureWithoutSmoothing) {
  const TriangleMesh mesh = test::make_sphere(1.0, 1);
  const UmbrellaOperator umbrella(mesh);
  const std::vector<double> weights(mesh.vertices.size(), 1.0);
  const SmoothingTerm none(mesh, umbrella, weights, {0.0, 0.0});
  VertexField data(mesh.vertices.size());
  data.add(3, {1.0, -2.0, 0.5}, 4.0);
  data.add(5, {0.0, 3.0, 0.0}, 1.5);
  const std::vector<std::uint8_t> movable(mesh.vertices.size(), 1);
  const VectorField step = solve_step(mesh, data, none, movable);
  EXPECT_NEAR((step[3] - Eigen::Vector3d(-0.25, 0.5, -0.125)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((step[5] - Eigen::Vector3d(0.0, -2.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(step[0].norm(), 0.0);
}

TEST(Step, UnmovableVerticesStay) {
  TriangleMesh mesh = test::make_sphere(1.0, 3);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (Eigen::Vector3d& v : mesh.vertices) {
    v *= 1.0 + noise(random);
  }
  const UmbrellaOperator umbrella(mesh);
  std::vector<double> weights(mesh.vertices.size(), 1.0);
  std::vector<std::uint8_t> movable(mesh.vertices.size(), 1);
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    if (mesh.vertices[k].z() < 0.0) {
      weights[k] = 0.0;
      movable[k] = 0;
    }
  }
  const SmoothingTerm term(mesh, umbrella, weights, SmoothingConfig{});
  const VectorField step = solve_step(mesh, VertexField(mesh.vertices.size()), term, movable);
  double moved = 0.0;
  for (std::size_t k = 0; k < step.size(); ++k) {
    if (movable[k] == 0) {
      EXPECT_EQ(step[k].norm(), 0.0);
    }
    moved += step[k].norm();
  }
  EXPECT_GT(moved, 0.1);
}

TEST(Step, LimitedToAFractionOfTheEdges) {
  const TriangleMesh mesh = test::make_grid_plane(6, 6, 0.1);
  const Adjacency neighbours = vertex_neighbours(mesh);
  VectorField step(mesh.vertices.size(), Eigen::Vector3d(0.0, 0.0, 1.0));
  step[24] = {0.0, 0.0, 1e-3};
  limit_step(mesh, neighbours, 0.25, &step);
  EXPECT_NEAR(step[24].z(), 1e-3, 1e-12);
  const double mean_edge = 0.1 * (4.0 + 2.0 * std::sqrt(2.0)) / 6.0;
  EXPECT_NEAR(step[25].z(), 0.25 * mean_edge, 1e-9);
}

TEST(Step, NoFacetFlipsUnderAnyStep) {
  const TriangleMesh mesh = test::make_sphere(1.0, 3);
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 0.3);
  VectorField step;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    step.emplace_back(noise(random), noise(random), noise(random));
  }
  EXPECT_GT(prevent_flips(mesh, &step), 0U);
  TriangleMesh moved = mesh;
  for (std::size_t k = 0; k < step.size(); ++k) {
    moved.vertices[k] += step[k];
  }
  const std::vector<Eigen::Vector3d> before = facet_normals(mesh);
  const std::vector<Eigen::Vector3d> after = facet_normals(moved);
  for (std::size_t f = 0; f < before.size(); ++f) {
    EXPECT_GT(before[f].dot(after[f]), 0.19);
  }
}

TEST(Step, HarmlessStepsPassUnchanged) {
  const TriangleMesh mesh = test::make_sphere(1.0, 3);
  VectorField step(mesh.vertices.size(), Eigen::Vector3d(0.3, 0.2, -0.1));
  const VectorField asked = step;
  EXPECT_EQ(prevent_flips(mesh, &step), 0U);
  EXPECT_EQ(step, asked);
}

TEST(Step, FacetsWithoutAreaDoNotBlock) {
  TriangleMesh mesh = test::make_grid_plane(2, 2, 0.1);
  mesh.vertices[4] = mesh.vertices[3];
  VectorField step(mesh.vertices.size(), Eigen::Vector3d(0.0, 0.0, 0.01));
  prevent_flips(mesh, &step);
  EXPECT_GT(step[8].norm(), 0.0);
}

}  // namespace
}  // namespace facet_mapping
