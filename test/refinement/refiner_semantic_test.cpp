// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The semantic flow alone: masks move class borders and silhouettes.
#include <cmath>

#include "refine_scenes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

/// Pixels where rendering and mask disagree about class 1.
int wrong_pixels(const TriangleMesh& mesh, const std::vector<LabeledView>& views) {
  int wrong = 0;
  for (const LabeledView& view : views) {
    const cv::Mat shown = label_image(make_renderer()->render(mesh, view.view), mesh);
    wrong += cv::countNonZero((shown == 1) != (view.labels == 1));
  }
  return wrong;
}

RefinementConfig semantic_config(SemanticMode mode) {
  RefinementConfig config;
  config.photometric = false;
  config.relabel = false;
  config.semantic = mode;
  config.semantic_weight = 10.0;  // there is nothing beside it but smoothing
  config.levels = 1;
  config.iterations = 12;
  config.subdivide_px = 1e9;
  return config;
}

/// A plane of two classes; the mesh's class border is a wave that the straight mask does not show.
test::Scene striped_plane() {
  test::Scene scene = test::wavy_plane();
  scene.mesh = test::make_height_field(60, 48, 0.06, [](double, double) { return 0.0; });
  for (const Triangle& t : scene.mesh.triangles) {
    const Eigen::Vector3d center =
        (scene.mesh.vertices[t[0]] + scene.mesh.vertices[t[1]] + scene.mesh.vertices[t[2]]) / 3.0;
    scene.mesh.labels.push_back(center.x() < 0.04 * std::sin(3.0 * center.y()) ? 1 : 2);
  }
  for (LabeledView& view : scene.views) {
    view.labels = cv::Mat(view.gray.size(), CV_16UC1);
    for (int y = 0; y < view.labels.rows; ++y) {
      for (int x = 0; x < view.labels.cols; ++x) {
        const Eigen::Vector3d direction =
            view.view.world_from_cam.linear() *
            view.view.camera.ray({static_cast<double>(x), static_cast<double>(y)});
        const Eigen::Vector3d eye = view.view.center();
        const double hit = eye.x() - eye.z() / direction.z() * direction.x();
        view.labels.at<Label>(y, x) = hit < 0.0 ? 1 : 2;
      }
    }
  }
  return scene;
}

/// A ball before nothing that is too small for its mask by two to three pixels.
test::Scene small_ball() {
  test::Scene scene;
  scene.mesh = test::make_sphere(0.77, 5);
  scene.mesh.labels.assign(scene.mesh.triangles.size(), 1);
  const PinholeCamera camera = test::make_camera(240, 180, 220.0);
  for (const View& pose : test::arc_of_views(camera, Eigen::Vector3d::Zero(), 3.0, 25.0, 3)) {
    LabeledView view;
    view.view = pose;
    view.gray = cv::Mat(180, 240, CV_8UC1, cv::Scalar(100));
    view.labels = cv::Mat(180, 240, CV_16UC1, cv::Scalar(0));
    const double radius = 220.0 * 0.8 / std::sqrt(pose.center().squaredNorm() - 0.64);
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 240; ++x) {
        if (std::hypot(x - camera.cx, y - camera.cy) < radius) {
          view.labels.at<Label>(y, x) = 1;
        }
      }
    }
    scene.views.push_back(view);
  }
  return scene;
}

TEST(RefineSemantic, FullFlowSlidesAClassBorderToTheMask) {
  const test::Scene scene = striped_plane();
  const RefinementResult result =
      refine(scene.mesh, scene.views, LabelSet(), semantic_config(SemanticMode::kFull));
  EXPECT_LT(result.after.semantic, 0.5 * result.before.semantic);
  EXPECT_LT(wrong_pixels(result.mesh, scene.views), 0.5 * wrong_pixels(scene.mesh, scene.views));
}

TEST(RefineSemantic, BothFlowsMoveASilhouetteToTheMask) {
  const test::Scene scene = small_ball();
  for (const SemanticMode mode : {SemanticMode::kNormal, SemanticMode::kFull}) {
    const RefinementResult result =
        refine(scene.mesh, scene.views, LabelSet(), semantic_config(mode));
    EXPECT_LT(result.after.semantic, 0.5 * result.before.semantic);
    EXPECT_LT(wrong_pixels(result.mesh, scene.views), 0.1 * wrong_pixels(scene.mesh, scene.views));
  }
}

TEST(RefineSemantic, OffLeavesThePlaneAlone) {
  const test::Scene scene = striped_plane();
  RefinementConfig config = semantic_config(SemanticMode::kOff);
  config.smoothing = 0.0;
  config.thin_plate = 0.0;
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(result.mesh.vertices, scene.mesh.vertices);
  EXPECT_GT(result.before.semantic, 0.0);
  EXPECT_EQ(result.before.semantic, result.after.semantic);
}

}  // namespace
}  // namespace facet_mapping
