// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole refinement against known shapes.
#include <algorithm>
#include <cmath>

#include "refine_scenes.h"
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

using test::ball_error_px;
using test::plane_error_px;
using test::Scene;

TEST(RefinePhotometric, PlaneReturnsToTheTruth) {
  const Scene scene = test::wavy_plane();
  const RefinementResult result =
      refine(scene.mesh, scene.views, LabelSet(), test::photometric_config());
  const double before = plane_error_px(scene, scene.mesh);
  const double after = plane_error_px(scene, result.mesh);
  RecordProperty("rms_px_before", std::to_string(before));
  RecordProperty("rms_px_after", std::to_string(after));
  EXPECT_GT(before, 0.35);
  EXPECT_LT(after, 0.05);
  EXPECT_LT(result.after.photometric, 0.2 * result.before.photometric);
  EXPECT_FALSE(result.cancelled);
}

TEST(RefinePhotometric, BallReturnsToTheTruth) {
  const Scene scene = test::bumpy_ball(5);
  const RefinementResult result =
      refine(scene.mesh, scene.views, LabelSet(), test::photometric_config());
  const double before = ball_error_px(scene, scene.mesh);
  const double after = ball_error_px(scene, result.mesh);
  RecordProperty("rms_px_before", std::to_string(before));
  RecordProperty("rms_px_after", std::to_string(after));
  EXPECT_GT(before, 0.2);
  EXPECT_LT(after, 0.05);
  EXPECT_LT(result.after.photometric, 0.3 * result.before.photometric);
}

TEST(RefinePhotometric, TheTruthStays) {
  Scene scene = test::wavy_plane();
  for (Eigen::Vector3d& v : scene.mesh.vertices) {
    v.z() = 0.0;
  }
  const RefinementResult result =
      refine(scene.mesh, scene.views, LabelSet(), test::photometric_config());
  EXPECT_LT(plane_error_px(scene, result.mesh), 0.02);
  EXPECT_LE(result.after.photometric, result.before.photometric);
}

/// Coarse facets: the refinement must split them to follow the ball.
TEST(RefinePhotometric, MeshStaysAClosedManifoldWithoutFlips) {
  const Scene scene = test::bumpy_ball(3);
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 12.0;
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  const ManifoldReport report = check_manifold(result.mesh);
  EXPECT_TRUE(report.is_closed_manifold()) << report.to_string();
  EXPECT_EQ(result.facets_before, scene.mesh.triangles.size());
  EXPECT_EQ(result.facets_after, result.mesh.triangles.size());
  EXPECT_GT(result.facets_after, 4 * result.facets_before);
  const std::vector<Eigen::Vector3d> normals = facet_normals(result.mesh);
  for (std::size_t f = 0; f < normals.size(); ++f) {
    EXPECT_GT(normals[f].dot(result.mesh.vertices[result.mesh.triangles[f][0]]), 0.0);
  }
  EXPECT_LT(ball_error_px(scene, result.mesh), 0.5 * ball_error_px(scene, scene.mesh));
}

TEST(RefinePhotometric, WhatNoViewSeesStays) {
  const Scene scene = test::bumpy_ball(4);
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 1e9;
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  std::size_t moved = 0;
  for (std::size_t k = 0; k < scene.mesh.vertices.size(); ++k) {
    const bool same = result.mesh.vertices[k] == scene.mesh.vertices[k];
    moved += same ? 0 : 1;
    EXPECT_TRUE(same || scene.mesh.vertices[k].z() > 0.1);
  }
  EXPECT_GT(moved, 100U);
}

TEST(RefinePhotometric, SmoothingAloneDoesNotShrinkTheBall) {
  Scene scene = test::bumpy_ball(4);
  for (Eigen::Vector3d& v : scene.mesh.vertices) {
    v *= test::kBallRadius / v.norm();
  }
  RefinementConfig config = test::photometric_config();
  config.photometric = false;
  config.levels = 1;
  config.iterations = 20;
  config.subdivide_px = 1e9;
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  double mean = 0.0;
  int count = 0;
  for (const Eigen::Vector3d& v : result.mesh.vertices) {
    if (v.z() > 1.2) {
      mean += v.norm();
      ++count;
    }
  }
  EXPECT_NEAR(mean / count / test::kBallRadius, 1.0, 0.002);
}

/// The largest difference, in pixels of parallax, that another unit of length makes.
double unit_error_px(const Scene& scene, double scale, const RefinementConfig& config) {
  Scene scaled = scene;
  for (Eigen::Vector3d& v : scaled.mesh.vertices) {
    v *= scale;
  }
  for (LabeledView& view : scaled.views) {
    view.view.world_from_cam.translation() *= scale;
  }
  const RefinementResult a = refine(scene.mesh, scene.views, LabelSet(), config);
  const RefinementResult b = refine(scaled.mesh, scaled.views, LabelSet(), config);
  EXPECT_TRUE(a.mesh.triangles == b.mesh.triangles);
  EXPECT_NEAR(a.after.photometric, b.after.photometric, 1e-4);
  double worst = 0.0;
  for (std::size_t k = 0; k < a.mesh.vertices.size(); ++k) {
    worst = std::max(worst, (b.mesh.vertices[k] / scale - a.mesh.vertices[k]).norm());
  }
  return worst * scene.parallax_px_per_m;
}

TEST(RefinePhotometric, MillimetresGiveTheSameResult) {
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 1e9;  // a facet exactly at the limit may go either way
  EXPECT_LT(unit_error_px(test::bumpy_ball(4), 1000.0, config), 0.05);
}

/// A power of two changes no rounding, so that subdivision too must be the same.
TEST(RefinePhotometric, SubdivisionFollowsTheUnitOfLength) {
  EXPECT_LT(unit_error_px(test::bumpy_ball(3), 1024.0, test::photometric_config()), 1e-6);
}

}  // namespace
}  // namespace facet_mapping
