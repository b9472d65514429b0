// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "support/meshes.h"
#include "textured_scene.h"
#include <gtest/gtest.h>

#include "facet_mapping/refinement/photometric_energy.h"

namespace facet_mapping {
namespace {

using test::Surface;
using test::Texture;

constexpr double kMinCos = 0.15;

/// A mesh, the images of the true surface, and the pairs of the energy under test.
struct Problem {
  TriangleMesh mesh;
  std::vector<View> poses;
  std::vector<PhotometricView> views;
  std::vector<std::vector<int>> partners;
  ZnccConfig config;

  double energy(const TriangleMesh& moved) const {
    return photometric_energy(
               moved, views, render_surfaces(moved, poses, kMinCos), partners, config, false)
        .sum;
  }

  PhotometricEnergy with_gradient() const {
    return photometric_energy(
        mesh, views, render_surfaces(mesh, poses, kMinCos), partners, config, true);
  }
};

Problem make_problem(TriangleMesh mesh,
                     const Surface& surface,
                     const std::vector<View>& poses,
                     double wavelength) {
  const Texture texture(wavelength, 11);
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.poses = poses;
  for (const View& pose : poses) {
    problem.views.push_back(make_photometric_view(
        pose, test::cast_image(pose, surface, texture), problem.config.window_px));
  }
  problem.partners = {{1}, {0, 2}, {1}};
  return problem;
}

/// Waves with some pixels of amplitude, so that the energy is not at its minimum.
double wave(double x, double y) {
  return 0.06 * std::sin(5.0 * x + 0.3) * std::cos(4.0 * y - 0.2);
}

Problem plane_problem() {
  const PinholeCamera camera = test::make_camera(240, 180, 300.0);
  return make_problem(test::make_height_field(24, 20, 0.07, wave),
                      test::plane_surface(),
                      test::arc_of_views(camera, Eigen::Vector3d::Zero(), 3.0, 9.0, 3),
                      0.15);
}

Problem cap_problem() {
  constexpr double kRadius = 1.5;
  const PinholeCamera camera = test::make_camera(240, 180, 260.0);
  TriangleMesh cap = test::make_height_field(24, 20, 0.06, [](double x, double y) {
    return std::sqrt(kRadius * kRadius - x * x - y * y) + wave(x, y);
  });
  return make_problem(std::move(cap),
                      test::sphere_surface(kRadius),
                      test::arc_of_views(camera, {0.0, 0.0, kRadius}, 2.5, 9.0, 3),
                      0.13);
}

/// Random vectors at the inner vertices: at the rim which pixels count would change.
std::vector<Eigen::Vector3d> random_direction(const Problem& problem, unsigned seed, bool smooth) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> direction;
  const Eigen::Vector3d a(normal(random), normal(random), normal(random));
  for (const Eigen::Vector3d& x : problem.mesh.vertices) {
    const bool inner = std::abs(x.x()) < 0.55 && std::abs(x.y()) < 0.45;
    const Eigen::Vector3d free(normal(random), normal(random), normal(random));
    const Eigen::Vector3d waved = a * std::sin(3.0 * x.dot(a) + a.x());
    direction.push_back(inner ? (smooth ? waved : free) : Eigen::Vector3d::Zero());
  }
  return direction;
}

double difference(const Problem& problem, const std::vector<Eigen::Vector3d>& direction) {
  constexpr double kStep = 2e-4;  // about 0.01 pixels of parallax
  TriangleMesh ahead = problem.mesh;
  TriangleMesh back = problem.mesh;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    ahead.vertices[k] += kStep * direction[k];
    back.vertices[k] -= kStep * direction[k];
  }
  return (problem.energy(ahead) - problem.energy(back)) / (2.0 * kStep);
}

void expect_agreement(const Problem& problem) {
  const PhotometricEnergy here = problem.with_gradient();
  ASSERT_GT(here.pixels, 20000U);
  ASSERT_GT(here.mean(), 0.005);
  for (unsigned seed = 0; seed < 8; ++seed) {
    const std::vector<Eigen::Vector3d> direction = random_direction(problem, seed, seed % 2 == 0);
    double analytic = 0.0;
    double scale = 0.0;
    for (std::size_t k = 0; k < direction.size(); ++k) {
      analytic += here.field.gradient[k].dot(direction[k]);
      scale += std::pow(here.field.gradient[k].norm() * direction[k].norm(), 2);
    }
    const double expected = difference(problem, direction);
    EXPECT_NEAR(analytic, expected, 0.02 * std::max(std::abs(expected), 0.5 * std::sqrt(scale)));
  }
}

TEST(PhotometricGradient, AgreesWithFiniteDifferencesOnAPlane) {
  expect_agreement(plane_problem());
}

TEST(PhotometricGradient, AgreesWithFiniteDifferencesOnASphereCap) {
  expect_agreement(cap_problem());
}

TEST(PhotometricEnergy, IsSmallestAtTheTrueSurface) {
  Problem problem = plane_problem();
  TriangleMesh flat = problem.mesh;
  for (Eigen::Vector3d& v : flat.vertices) {
    v.z() = 0.0;
  }
  EXPECT_LT(problem.energy(flat), 0.02 * problem.energy(problem.mesh));
}

TEST(PhotometricEnergy, FollowsTheUnitOfLength) {
  Problem metres = plane_problem();
  Problem millimetres = metres;
  for (Eigen::Vector3d& v : millimetres.mesh.vertices) {
    v *= 1000.0;
  }
  for (std::size_t i = 0; i < metres.poses.size(); ++i) {
    millimetres.poses[i].world_from_cam.translation() *= 1000.0;
    millimetres.views[i].view = millimetres.poses[i];
  }
  const PhotometricEnergy a = metres.with_gradient();
  const PhotometricEnergy b = millimetres.with_gradient();
  EXPECT_NEAR(a.sum, b.sum, 1e-3 * a.sum);
  double worst = 0.0;
  for (std::size_t k = 0; k < a.field.gradient.size(); ++k) {
    worst = std::max(worst, (a.field.gradient[k] - 1000.0 * b.field.gradient[k]).norm());
  }
  EXPECT_LT(worst, 0.02 * a.field.gradient[300].norm() + 1.0);
}

/// A second wall that hides half of the scene from one view only.
TEST(PhotometricEnergy, HiddenPixelsDoNotCount) {
  const Problem problem = plane_problem();
  Problem hidden = problem;
  const Eigen::Vector3d eye = problem.poses[0].center();
  TriangleMesh wall = test::make_grid_plane(2, 2, 0.1);
  for (Eigen::Vector3d& v : wall.vertices) {
    v += 0.8 * eye;
  }
  hidden.mesh = test::joined(hidden.mesh, wall);
  hidden.partners = {{}, {0}, {}};
  Problem open = problem;
  open.partners = {{}, {0}, {}};
  const std::size_t all = open.with_gradient().pixels;
  const std::size_t some = hidden.with_gradient().pixels;
  EXPECT_LT(some, all - 2000U);
  EXPECT_GT(some, all / 4);
}

TEST(PhotometricEnergy, GrazingFacetsGetNoForce) {
  const PinholeCamera camera = test::make_camera(240, 180, 300.0);
  std::vector<View> poses;
  for (const double x : {-0.4, 0.0, 0.4}) {
    poses.push_back(test::look_at(camera, {x, -4.0, 0.35}, {0.0, 0.0, 0.0}));
  }
  const Problem problem =
      make_problem(test::make_height_field(24, 20, 0.07, [](double, double) { return 0.0; }),
                   test::plane_surface(),
                   poses,
                   0.15);
  const PhotometricEnergy energy = problem.with_gradient();
  EXPECT_EQ(energy.pixels, 0U);
  for (const Eigen::Vector3d& g : energy.field.gradient) {
    EXPECT_EQ(g.norm(), 0.0);
  }
}

PhotometricEnergy energy_of(const std::vector<std::uint16_t>& pixels) {
  PhotometricEnergy energy;
  energy.maps = {{cv::Mat(1, static_cast<int>(pixels.size()), CV_16UC1)}};
  std::copy(pixels.begin(), pixels.end(), energy.maps[0][0].begin<std::uint16_t>());
  return energy;
}

TEST(PhotometricChange, OnlyPixelsOfBothShapesCount) {
  const PhotometricEnergy from = energy_of({3000, 6000, kNotCounted, 60000});
  EXPECT_DOUBLE_EQ(mean_change(from, from), 0.0);
  // One pixel better by 0.1, one hidden that was bad, one shown that is bad.
  const PhotometricEnergy to = energy_of({3000, 3000, 60000, kNotCounted});
  EXPECT_DOUBLE_EQ(mean_change(from, to), -0.05);
  EXPECT_DOUBLE_EQ(mean_change(to, from), 0.05);
  EXPECT_DOUBLE_EQ(mean_change(from, energy_of({kNotCounted, kNotCounted, 5, kNotCounted})), 0.0);
  EXPECT_THROW(mean_change(from, PhotometricEnergy()), std::invalid_argument);
}

TEST(PhotometricChange, MapsHoldTheSum) {
  const Problem problem = plane_problem();
  const PhotometricEnergy energy =
      photometric_energy(problem.mesh,
                         problem.views,
                         render_surfaces(problem.mesh, problem.poses, kMinCos),
                         problem.partners,
                         problem.config,
                         false);
  double sum = 0.0;
  std::size_t pixels = 0;
  for (const std::vector<cv::Mat>& maps : energy.maps) {
    for (const cv::Mat& map : maps) {
      for (auto at = map.begin<std::uint16_t>(); at != map.end<std::uint16_t>(); ++at) {
        pixels += *at != kNotCounted ? 1 : 0;
        sum += *at != kNotCounted ? *at / kEnergyUnits : 0.0;
      }
    }
  }
  EXPECT_EQ(pixels, energy.pixels);
  EXPECT_NEAR(sum / energy.sum, 1.0, 1e-3);
}

}  // namespace
}  // namespace facet_mapping
