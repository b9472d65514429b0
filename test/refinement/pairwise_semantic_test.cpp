// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/pairwise_semantic.h"

#include <cmath>
#include <random>

#include "refine_scenes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

struct Problem {
  TriangleMesh mesh;
  std::vector<SemanticView> views;
  std::vector<View> poses;
  std::vector<std::vector<int>> partners;

  PairwiseSemanticEnergy energy(const TriangleMesh& moved, bool with_gradient) const {
    return pairwise_semantic_energy(
        moved, views, render_surfaces(moved, poses, 0.15), partners, with_gradient);
  }
};

/// Stripes of three classes on the plane z = 0, seen by three views; the mesh is a wavy plane.
Problem striped_plane() {
  const test::Scene scene = test::wavy_plane();
  Problem problem;
  problem.mesh = scene.mesh;
  for (const LabeledView& view : scene.views) {
    cv::Mat labels(view.gray.size(), CV_16UC1);
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        const Eigen::Vector3d direction =
            view.view.world_from_cam.linear() *
            view.view.camera.ray({static_cast<double>(x), static_cast<double>(y)});
        const Eigen::Vector3d eye = view.view.center();
        const Eigen::Vector3d hit = eye - eye.z() / direction.z() * direction;
        const double stripe = std::floor((hit.x() + 0.2 * std::sin(5.0 * hit.y())) / 0.11);
        labels.at<Label>(y, x) = static_cast<Label>(std::fmod(stripe + 300.0, 3.0));
      }
    }
    problem.views.push_back({view.view, labels});
    problem.poses.push_back(view.view);
  }
  problem.partners = {{1}, {0, 2}, {1}};
  return problem;
}

TEST(PairwiseSemantic, GradientAgreesWithFiniteDifferences) {
  const Problem problem = striped_plane();
  const PairwiseSemanticEnergy here = problem.energy(problem.mesh, true);
  ASSERT_GT(here.pixels, 10000U);
  constexpr double kStep = 2e-4;
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 4; ++round) {
    TriangleMesh ahead = problem.mesh;
    TriangleMesh back = problem.mesh;
    double analytic = 0.0;
    for (std::size_t k = 0; k < problem.mesh.vertices.size(); ++k) {
      const Eigen::Vector3d free(normal(random), normal(random), normal(random));
      const Eigen::Vector3d& x = problem.mesh.vertices[k];
      if (std::abs(x.x()) < 0.7 && std::abs(x.y()) < 0.5) {
        ahead.vertices[k] += kStep * free;
        back.vertices[k] -= kStep * free;
        analytic += here.field.gradient[k].dot(free);
      }
    }
    const double expected =
        (problem.energy(ahead, false).sum - problem.energy(back, false).sum) / (2.0 * kStep);
    EXPECT_NEAR(analytic, expected, 0.03 * std::abs(expected) + 20.0);
  }
}

TEST(PairwiseSemantic, IsSmallestAtTheTrueSurface) {
  const Problem problem = striped_plane();
  TriangleMesh flat = problem.mesh;
  for (Eigen::Vector3d& v : flat.vertices) {
    v.z() = 0.0;
  }
  EXPECT_LT(problem.energy(flat, false).sum, 0.9 * problem.energy(problem.mesh, false).sum);
}

TEST(PairwiseSemantic, PixelsWithoutSegmentationSayNothing) {
  Problem problem = striped_plane();
  problem.views[1].segmentation.setTo(cv::Scalar(kUnlabelled));
  const PairwiseSemanticEnergy energy = problem.energy(problem.mesh, true);
  EXPECT_EQ(energy.pixels, 0U);
  EXPECT_EQ(energy.sum, 0.0);
}

}  // namespace
}  // namespace facet_mapping
