// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/smoothing.h"

#include <cmath>
#include <random>

#include "support/meshes.h"
#include <gtest/gtest.h>

#include "facet_mapping/refinement/step.h"

namespace facet_mapping {
namespace {

double mean_radius(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    sum += v.norm();
  }
  return sum / static_cast<double>(mesh.vertices.size());
}

double roughness(const TriangleMesh& mesh, double radius) {
  double sum = 0.0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    sum += std::pow(v.norm() - radius, 2);
  }
  return std::sqrt(sum / static_cast<double>(mesh.vertices.size()));
}

/// Smoothing alone: no data, every vertex equally well seen.
TriangleMesh smooth(TriangleMesh mesh, const SmoothingConfig& config, int iterations) {
  const UmbrellaOperator umbrella(mesh);
  const std::vector<double> weights(mesh.vertices.size(), 1.0);
  const std::vector<std::uint8_t> movable(mesh.vertices.size(), 1);
  const VertexField nothing(mesh.vertices.size());
  for (int k = 0; k < iterations; ++k) {
    const SmoothingTerm term(mesh, umbrella, weights, config);
    VectorField step = solve_step(mesh, nothing, term, movable);
    limit_step(mesh, umbrella.neighbours(), 0.25, &step);
    for (std::size_t v = 0; v < step.size(); ++v) {
      mesh.vertices[v] += step[v];
    }
  }
  return mesh;
}

TEST(Smoothing, DoesNotShrinkASphere) {
  SmoothingConfig config;
  for (const int subdivisions : {2, 3}) {
    const TriangleMesh sphere = test::make_sphere(1.0, subdivisions);
    for (const bool thin_plate : {false, true}) {
      config.thin_plate = thin_plate ? 0.2 : 0.0;
      const double radius = mean_radius(smooth(sphere, config, 20));
      EXPECT_NEAR(radius, 1.0, 0.005);
    }
  }
}

TEST(Smoothing, TakesNoiseAway) {
  TriangleMesh sphere = test::make_sphere(1.0, 4);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (Eigen::Vector3d& v : sphere.vertices) {
    v *= 1.0 + noise(random);
  }
  const double before = roughness(sphere, mean_radius(sphere));
  const TriangleMesh smoothed = smooth(sphere, SmoothingConfig{}, 5);
  EXPECT_LT(roughness(smoothed, mean_radius(smoothed)), 0.35 * before);
}

TEST(Smoothing, KeepsThePlaneAndTheBorderOfAnOpenMesh) {
  TriangleMesh plane = test::make_grid_plane(10, 10, 0.1);
  plane.vertices[60].z() = 0.05;
  const UmbrellaOperator umbrella(plane);
  const TriangleMesh smoothed = smooth(plane, SmoothingConfig{}, 30);
  for (std::size_t k = 0; k < plane.vertices.size(); ++k) {
    if (umbrella.is_border(k)) {
      EXPECT_EQ(smoothed.vertices[k], plane.vertices[k]);
    }
  }
  EXPECT_LT(std::abs(smoothed.vertices[60].z()), 0.01);
}

TEST(Smoothing, GradientAndHessianAreThoseOfTheEnergy) {
  TriangleMesh mesh = test::make_height_field(
      8, 7, 0.1, [](double x, double y) { return 0.05 * std::sin(9.0 * x + 5.0 * y); });
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.5, 2.0);
  std::normal_distribution<double> normal;
  std::vector<double> weights;
  const UmbrellaOperator umbrella(mesh);
  VectorField direction;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    weights.push_back(uniform(random));
    const Eigen::Vector3d free(normal(random), normal(random), normal(random));
    direction.push_back(umbrella.is_border(k) ? Eigen::Vector3d::Zero() : free);
  }
  const SmoothingTerm term(mesh, umbrella, weights, SmoothingConfig{});
  const auto energy_at = [&](double step) {
    VectorField x = mesh.vertices;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] += step * direction[k];
    }
    return term.energy(x);
  };
  const VectorField gradient = term.gradient(mesh.vertices);
  const VectorField curved = term.hessian_times(direction);
  double slope = 0.0;
  double bend = 0.0;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    slope += gradient[k].dot(direction[k]);
    bend += curved[k].dot(direction[k]);
  }
  constexpr double kStep = 1e-3;
  EXPECT_NEAR(slope, (energy_at(kStep) - energy_at(-kStep)) / (2 * kStep), 1e-8);
  EXPECT_NEAR(
      bend, (energy_at(kStep) - 2 * energy_at(0) + energy_at(-kStep)) / (kStep * kStep), 1e-5);
}

TEST(Smoothing, HessianDiagonalIsThatOfTheHessian) {
  const TriangleMesh mesh = test::make_grid_plane(5, 5, 0.1);
  const UmbrellaOperator umbrella(mesh);
  std::vector<double> weights(mesh.vertices.size(), 1.0);
  weights[14] = 3.0;
  const SmoothingTerm term(mesh, umbrella, weights, SmoothingConfig{});
  const std::vector<double> diagonal = term.hessian_diagonal();
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    VectorField unit(mesh.vertices.size(), Eigen::Vector3d::Zero());
    unit[k].x() = 1.0;
    EXPECT_NEAR(term.hessian_times(unit)[k].x(), diagonal[k], 1e-12);
  }
}

}  // namespace
}  // namespace facet_mapping
