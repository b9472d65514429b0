// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// No step of the refinement pushes the surface through itself.
#include "facet_mapping/refinement/crossings.h"

#include <random>

#include "ill_shaped.h"
#include "refine_scenes.h"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "facet_mapping/refinement/mesh_quality.h"
#include "facet_mapping/refinement/step.h"

namespace facet_mapping {
namespace {

/// Two sheets of squares of 0.1 m, the lower one seen from below, `gap_m` apart.
TriangleMesh thin_wall(double gap_m) {
  TriangleMesh lower = test::flipped(test::make_grid_plane(12, 12, 0.1));
  for (Eigen::Vector3d& v : lower.vertices) {
    v += Eigen::Vector3d(0.013, 0.021, -gap_m);
  }
  return test::joined(test::make_grid_plane(12, 12, 0.1), lower);
}

VectorField random_step(const TriangleMesh& mesh, int seed, double sigma_m) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_m);
  VectorField step;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    step.emplace_back(noise(random), noise(random), noise(random));
  }
  return step;
}

TriangleMesh moved(TriangleMesh mesh, const VectorField& step) {
  for (std::size_t k = 0; k < step.size(); ++k) {
    mesh.vertices[k] += step[k];
  }
  return mesh;
}

TEST(PreventCrossings, NoneIsAddedByAnyStep) {
  const TriangleMesh mesh = thin_wall(0.03);
  for (int seed = 0; seed < 10; ++seed) {
    VectorField step = random_step(mesh, seed, 0.02);
    VectorField unchecked = step;
    prevent_flips(mesh, &unchecked);
    ASSERT_GT(count_self_intersections(moved(mesh, unchecked)), 10U);
    EXPECT_GT(prevent_crossings(mesh, {}, &step), 10U);
    EXPECT_EQ(count_self_intersections(moved(mesh, step)), 0U);
    VectorField again = step;
    EXPECT_EQ(prevent_flips(mesh, &again), 0U);
  }
}

TEST(PreventCrossings, WhatCrossesAlreadyMayAndMayStop) {
  const TriangleMesh mesh = moved(thin_wall(0.03), random_step(thin_wall(0.03), 3, 0.012));
  const std::vector<FacetPair> known = find_self_intersections(mesh);
  ASSERT_GT(known.size(), 5U);
  for (int seed = 0; seed < 10; ++seed) {
    VectorField step = random_step(mesh, seed, 0.02);
    prevent_crossings(mesh, known, &step);
    const TriangleMesh after = moved(mesh, step);
    EXPECT_EQ(find_self_intersections(after), keep_crossing(after, known));
  }
}

TEST(PreventCrossings, StepsFarFromOtherSheetsPassUnchanged) {
  const TriangleMesh mesh = thin_wall(0.5);
  VectorField step = random_step(mesh, 1, 0.005);
  const VectorField asked = step;
  EXPECT_EQ(prevent_crossings(mesh, {}, &step), 0U);
  EXPECT_EQ(step, asked);
}

TEST(PreventCrossings, OnlyTheVerticesAroundACrossingAreHeld) {
  const TriangleMesh mesh = thin_wall(0.03);
  VectorField step(mesh.vertices.size(), Eigen::Vector3d(0.0, 0.0, 0.005));
  step[84] = {0.0, 0.0, -0.05};  // the middle of the upper sheet
  const VectorField asked = step;
  EXPECT_LT(prevent_crossings(mesh, {}, &step), 40U);
  EXPECT_GT(step[84].z(), -0.05);
  EXPECT_EQ(step[0], asked[0]);
}

TEST(Quality, StepsMakeNoFacetsCross) {
  for (int seed = 0; seed < 5; ++seed) {
    std::mt19937 random(seed);
    const auto wave = [](double x, double y) { return 0.03 * std::sin(9.0 * x + 4.0 * y); };
    TriangleMesh lower = test::flipped(test::make_height_field(24, 24, 0.1, wave));
    for (Eigen::Vector3d& v : lower.vertices) {
      v.z() -= 0.0015;
    }
    TriangleMesh mesh =
        test::joined(test::ill_shaped(test::make_height_field(24, 24, 0.1, wave), seed), lower);
    const std::size_t before = count_self_intersections(mesh);
    QualityReport report;
    const TriangleMesh better = improve_quality(mesh, {}, &report);
    EXPECT_GT(report.collapses + report.flips, 10U);
    EXPECT_LE(count_self_intersections(better), before);
  }
}

TEST(Subdivision, PiecesDoNotCrossMoreOftenThanTheFacetsDid) {
  const TriangleMesh mesh = moved(thin_wall(0.03), random_step(thin_wall(0.03), 3, 0.012));
  const std::size_t before = count_self_intersections(mesh);
  std::vector<double> pixels(mesh.triangles.size());
  for (std::size_t f = 0; f < pixels.size(); ++f) {
    pixels[f] = f % 7 == 0 ? 30.0 : 5.0;
  }
  const TriangleMesh split = subdivide_beside_crossings(mesh, pixels, 24.0);
  EXPECT_GT(split.triangles.size(), 1.1 * mesh.triangles.size());
  EXPECT_LE(count_self_intersections(split), before);
}

/// The images say that the front of a wall lies behind the place where the mesh has its back,
/// which no image sees.
test::Scene wall_with_its_back_in_front() {
  test::Scene scene = test::wavy_plane();
  for (Eigen::Vector3d& v : scene.mesh.vertices) {
    v.z() += 0.08;
  }
  TriangleMesh back = test::flipped(test::make_height_field(26, 20, 0.083, [](double x, double y) {
    return 0.012 + 0.008 * std::sin(5.0 * x + 2.0) * std::cos(7.0 * y);
  }));
  scene.mesh = test::joined(scene.mesh, back);
  return scene;
}

TEST(RefineCrossings, ASheetIsNotPulledThroughAnother) {
  const test::Scene scene = wall_with_its_back_in_front();
  ASSERT_EQ(count_self_intersections(scene.mesh), 0U);
  const RefinementResult result =
      refine(scene.mesh, scene.views, LabelSet(), test::photometric_config());
  EXPECT_EQ(count_self_intersections(result.mesh), 0U);
  EXPECT_LT(result.after.photometric, 0.8 * result.before.photometric);
}

TEST(RefineCrossings, TheResultDoesNotDependOnTheNumberOfThreads) {
  const test::Scene scene = wall_with_its_back_in_front();
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return refine(scene.mesh, scene.views, LabelSet(), test::photometric_config()).mesh;
  };
  const TriangleMesh one = with_threads(1);
  const TriangleMesh four = with_threads(4);
  EXPECT_EQ(one.triangles, four.triangles);
  EXPECT_EQ(one.vertices, four.vertices);
}

}  // namespace
}  // namespace facet_mapping
