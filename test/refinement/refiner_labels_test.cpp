// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What labels and class flags do in the whole refinement.
#include <cmath>

#include "refine_scenes.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/refinement/smoothing.h"

namespace facet_mapping {
namespace {

LabelSet two_classes(bool planar, bool sky) {
  ClassInfo one;
  one.id = 1;
  one.name = "one";
  one.planar = planar;
  ClassInfo two;
  two.id = 2;
  two.name = "two";
  two.color = {1, 2, 3};
  two.sky = sky;
  return LabelSet({one, two});
}

/// The wavy plane with a segmentation that shows class 1 left and class 2 right of the middle.
test::Scene segmented_plane() {
  test::Scene scene = test::wavy_plane();
  for (LabeledView& view : scene.views) {
    view.labels = cv::Mat(view.gray.size(), CV_16UC1, cv::Scalar(1));
    view.labels.colRange(120, 240).setTo(cv::Scalar(2));
  }
  return scene;
}

TEST(RefineLabels, AMeshWithoutLabelsIsLabelled) {
  const test::Scene scene = segmented_plane();
  RefinementConfig config;
  config.iterations = 2;
  config.levels = 1;
  const RefinementResult result =
      refine(scene.mesh, scene.views, two_classes(false, false), config);
  ASSERT_EQ(result.mesh.labels.size(), result.mesh.triangles.size());
  ASSERT_EQ(result.mesh.confidence.size(), result.mesh.triangles.size());
  int right = 0;
  int wrong = 0;
  for (std::size_t f = 0; f < result.mesh.triangles.size(); ++f) {
    const Eigen::Vector3d& v = result.mesh.vertices[result.mesh.triangles[f][0]];
    if (std::abs(v.x()) > 0.3 && std::abs(v.x()) < 1.0) {
      (result.mesh.labels[f] == (v.x() < 0.0 ? 1 : 2) ? right : wrong) += 1;
    }
  }
  EXPECT_GT(right, 100);
  EXPECT_LT(wrong, right / 50);
}

TEST(RefineLabels, WithoutRelabellingLabelsAreCarried) {
  test::Scene scene = segmented_plane();
  scene.mesh.labels.assign(scene.mesh.triangles.size(), 2);
  RefinementConfig config;
  config.iterations = 1;
  config.relabel = false;
  const RefinementResult result =
      refine(scene.mesh, scene.views, two_classes(false, false), config);
  for (const Label label : result.mesh.labels) {
    EXPECT_EQ(label, 2);
  }
  EXPECT_EQ(result.relabelled, 0U);
}

TEST(RefineLabels, SkyPixelsTellPhotometryNothing) {
  const test::Scene scene = segmented_plane();
  RefinementConfig config = test::photometric_config();
  config.smoothing = 0.0;
  config.thin_plate = 0.0;
  config.subdivide_px = 1e9;
  const RefinementResult result = refine(scene.mesh, scene.views, two_classes(false, true), config);
  std::size_t moved = 0;
  for (std::size_t k = 0; k < scene.mesh.vertices.size(); ++k) {
    const bool in_sky = scene.mesh.vertices[k].x() > 0.3;
    const double shift = (result.mesh.vertices[k] - scene.mesh.vertices[k]).norm();
    if (in_sky) {
      EXPECT_EQ(shift, 0.0);
    }
    moved += shift > 0.01 ? 1 : 0;
  }
  EXPECT_GT(moved, 50U);
}

/// Images that fit no surface: the less the mesh follows them the smoother it is.
TEST(RefineLabels, PlanarClassesAreSmoothedMore) {
  test::Scene scene = test::wavy_plane();
  scene.mesh.labels.assign(scene.mesh.triangles.size(), 1);
  cv::theRNG().state = 1;
  for (LabeledView& view : scene.views) {
    cv::randu(view.gray, 0, 255);
    cv::GaussianBlur(view.gray, view.gray, cv::Size(5, 5), 1.0);
  }
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 1e9;
  const auto motion = [&](double factor) {
    config.planar_smoothing = factor;
    const RefinementResult result =
        refine(scene.mesh, scene.views, two_classes(true, false), config);
    const VectorField bends = UmbrellaOperator(result.mesh).apply(result.mesh.vertices);
    double sum = 0.0;
    for (const Eigen::Vector3d& bend : bends) {
      sum += bend.squaredNorm();
    }
    return sum;
  };
  EXPECT_LT(motion(10.0), 0.7 * motion(1.0));
}

TEST(RefineLabels, PairwiseModeRunsBesideThePhotometricFlow) {
  test::Scene scene = segmented_plane();
  scene.mesh.labels.assign(scene.mesh.triangles.size(), 1);
  RefinementConfig config;
  config.relabel = false;
  config.semantic = SemanticMode::kPairwise;
  const RefinementResult result =
      refine(scene.mesh, scene.views, two_classes(false, false), config);
  EXPECT_LT(result.after.photometric, 0.5 * result.before.photometric);
}

}  // namespace
}  // namespace facet_mapping
