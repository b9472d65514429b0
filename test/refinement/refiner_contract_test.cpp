// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What refine() promises whatever the scene: arguments, progress, cancelling, determinism.
#include <limits>
#include <stdexcept>

#include "refine_scenes.h"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "facet_mapping/geometry/facet_search.h"

namespace facet_mapping {
namespace {

RefinementResult refine_with_threads(const test::Scene& scene,
                                     const RefinementConfig& config,
                                     std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return refine(scene.mesh, scene.views, LabelSet(), config);
}

TEST(RefineContract, ResultDoesNotDependOnTheNumberOfThreads) {
  const test::Scene scene = test::bumpy_ball(4);
  RefinementConfig config = test::photometric_config();
  config.iterations = 3;
  const RefinementResult one = refine_with_threads(scene, config, 1);
  const RefinementResult two = refine_with_threads(scene, config, 2);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(one.after.photometric, two.after.photometric);
}

TEST(RefineContract, ProgressRunsToTheEnd) {
  const test::Scene scene = test::bumpy_ball(3);
  std::vector<RefinementProgress> reports;
  refine(scene.mesh,
         scene.views,
         LabelSet(),
         test::photometric_config(),
         [&](const RefinementProgress& progress) {
           reports.push_back(progress);
           return true;
         });
  ASSERT_GT(reports.size(), 2U);
  EXPECT_EQ(reports.front().level, 1);
  EXPECT_EQ(reports.back().level, 0);
  for (std::size_t k = 1; k < reports.size(); ++k) {
    EXPECT_GT(reports[k].fraction, reports[k - 1].fraction);
    if (reports[k].level == reports[k - 1].level) {
      EXPECT_LE(reports[k].energy.photometric, 1.02 * reports[k - 1].energy.photometric);
    }
  }
  EXPECT_LE(reports.back().fraction, 1.0);
}

TEST(RefineContract, CancelReturnsTheBestSoFar) {
  const test::Scene scene = test::bumpy_ball(4);
  int calls = 0;
  const RefinementResult result = refine(scene.mesh,
                                         scene.views,
                                         LabelSet(),
                                         test::photometric_config(),
                                         [&](const RefinementProgress&) { return ++calls < 2; });
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(result.cancelled);
  EXPECT_LT(result.after.photometric, result.before.photometric);
  validate(result.mesh);
}

TEST(RefineContract, ZeroIterationsReturnTheStart) {
  const test::Scene scene = test::bumpy_ball(3);
  RefinementConfig config = test::photometric_config();
  config.iterations = 0;
  config.subdivide_px = 1e9;
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(result.mesh.vertices, scene.mesh.vertices);
  EXPECT_EQ(result.before.photometric, result.after.photometric);
}

TEST(RefineContract, TheResultSaysWhereItsVerticesLayAtTheStart) {
  test::Scene scene = test::bumpy_ball(3);
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 1e9;
  config.keep_quality = false;
  RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(result.mesh.start_points, scene.mesh.vertices);
  EXPECT_NE(result.mesh.vertices, scene.mesh.vertices);
  // A second refinement goes on from the first one's start.
  result = refine(result.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(result.mesh.start_points, scene.mesh.vertices);
}

TEST(RefineContract, TheStartPointsOfAFinerMeshLieOnTheStart) {
  const test::Scene scene = test::wavy_plane();
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 12.0;
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  ASSERT_GT(result.facets_after, result.facets_before);
  ASSERT_EQ(result.mesh.start_points.size(), result.mesh.vertices.size());
  const FacetSearch start(scene.mesh.vertices, scene.mesh.triangles);
  for (const Eigen::Vector3d& p : result.mesh.start_points) {
    EXPECT_LT((start.nearest(p).point - p).norm(), 0.01);
  }
}

TEST(RefineContract, TheEstimateChecksAndChangesNothing) {
  const test::Scene scene = test::bumpy_ball(3);
  const RefinementConfig config = test::photometric_config();
  const RefinementEstimate estimate =
      estimate_refinement(scene.mesh, scene.views, LabelSet(), config);
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(estimate.energy.photometric, result.before.photometric);
  EXPECT_EQ(estimate.views, scene.views.size());
  EXPECT_NEAR(estimate.facets, result.facets_after, 0.3 * result.facets_after);
  EXPECT_GT(estimate.seconds, estimate.measured_s);
  EXPECT_THROW(estimate_refinement(scene.mesh, {}, LabelSet(), config), std::invalid_argument);
}

TEST(RefineContract, ViewsWithoutCommonSurfaceAreHarmless) {
  test::Scene scene = test::bumpy_ball(3);
  for (LabeledView& view : scene.views) {
    view.view.world_from_cam.linear().col(0) *= -1.0;
    view.view.world_from_cam.linear().col(2) *= -1.0;  // looks away
  }
  const RefinementResult result =
      refine(scene.mesh, scene.views, LabelSet(), test::photometric_config());
  EXPECT_EQ(result.mesh.vertices, scene.mesh.vertices);
}

TEST(RefineContract, RefusesWrongViews) {
  const test::Scene scene = test::bumpy_ball(2);
  const RefinementConfig config = test::photometric_config();
  const auto with = [&](const std::vector<LabeledView>& views) {
    return refine(scene.mesh, views, LabelSet(), config);
  };
  EXPECT_THROW(with({}), std::invalid_argument);
  EXPECT_THROW(with({scene.views[0]}), std::invalid_argument);
  std::vector<LabeledView> views = scene.views;
  views[1].gray = cv::Mat();
  EXPECT_THROW(with(views), std::invalid_argument);
  views = scene.views;
  views[1].gray = cv::Mat(10, 10, CV_8UC1);
  EXPECT_THROW(with(views), std::invalid_argument);
  views = scene.views;
  views[1].labels = cv::Mat(views[1].gray.size(), CV_8UC1);
  EXPECT_THROW(with(views), std::invalid_argument);
  views = scene.views;
  views[1].view.camera.fx = -1.0;
  EXPECT_THROW(with(views), std::invalid_argument);
  views = scene.views;
  views[1].view.world_from_cam.linear() *= 2.0;
  EXPECT_THROW(with(views), std::invalid_argument);
}

TEST(RefineContract, RefusesWrongMeshes) {
  const test::Scene scene = test::bumpy_ball(2);
  const auto with = [&](const TriangleMesh& mesh) {
    return refine(mesh, scene.views, LabelSet(), test::photometric_config());
  };
  EXPECT_THROW(with(TriangleMesh{}), std::invalid_argument);
  TriangleMesh mesh = scene.mesh;
  mesh.triangles[0][1] = 100000;
  EXPECT_THROW(with(mesh), std::invalid_argument);
  mesh = scene.mesh;
  mesh.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(with(mesh), std::invalid_argument);
  mesh = scene.mesh;
  mesh.labels = {1, 2};
  EXPECT_THROW(with(mesh), std::invalid_argument);
}

TEST(RefineContract, RefusesWrongParameters) {
  const test::Scene scene = test::bumpy_ball(2);
  const auto with = [&](const std::function<void(RefinementConfig*)>& change) {
    RefinementConfig config = test::photometric_config();
    change(&config);
    return refine(scene.mesh, scene.views, LabelSet(), config);
  };
  using C = RefinementConfig;
  EXPECT_THROW(with([](C* c) { c->levels = 0; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->iterations = -1; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->ncc_window_px = 4; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->semantic_window_px = 1; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->smoothing = 1.5; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->thin_plate = -0.1; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->min_incidence_cos = 0.0; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->pairs_per_view = 0; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->max_step_edge_fraction = 0.0; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->subdivide_px = 0.0; }), std::invalid_argument);
  EXPECT_THROW(with([](C* c) { c->semantic_weight = std::nan(""); }), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
