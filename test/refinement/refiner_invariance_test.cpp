// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The unit of length and the images' size change nothing, with all parameters at their defaults.
#include <algorithm>
#include <cmath>

#include "ill_shaped.h"
#include "refine_scenes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using test::Scene;

Label half(const Eigen::Vector3d& point) {
  return point.x() + 0.2 * std::sin(3.0 * point.y()) < 0.05 ? 1 : 2;
}

/// With irregular facets: which of two sides of the same length is split is a matter of rounding.
Scene segmented_ball() {
  Scene scene = test::bumpy_ball(4);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.004);
  for (Eigen::Vector3d& v : scene.mesh.vertices) {
    v += Eigen::Vector3d(noise(random), noise(random), noise(random));
  }
  test::segment(test::sphere_surface(test::kBallRadius), half, &scene.views);
  return scene;
}

Scene scaled(Scene scene, double factor) {
  for (Eigen::Vector3d& v : scene.mesh.vertices) {
    v *= factor;
  }
  for (LabeledView& view : scene.views) {
    view.view.world_from_cam.translation() *= factor;
  }
  return scene;
}

class UnitOfLengthTest : public testing::TestWithParam<double> {};

TEST_P(UnitOfLengthTest, ScalesTheResult) {
  const Scene scene = segmented_ball();
  const Scene other = scaled(scene, GetParam());
  const RefinementResult a = refine(scene.mesh, scene.views, LabelSet(), {});
  const RefinementResult b = refine(other.mesh, other.views, LabelSet(), {});
  EXPECT_GT(a.mesh.triangles.size(), scene.mesh.triangles.size());  // some were split
  ASSERT_TRUE(a.mesh.triangles == b.mesh.triangles);
  EXPECT_EQ(a.mesh.labels, b.mesh.labels);
  EXPECT_NEAR(a.after.photometric, b.after.photometric, 2e-4);
  EXPECT_NEAR(a.after.semantic, b.after.semantic, 1e-3);
  double sum = 0.0;
  double worst = 0.0;
  for (std::size_t k = 0; k < a.mesh.vertices.size(); ++k) {
    const double error_px =
        scene.parallax_px_per_m * (b.mesh.vertices[k] / GetParam() - a.mesh.vertices[k]).norm();
    sum += error_px * error_px;
    worst = std::max(worst, error_px);
  }
  const double rms = std::sqrt(sum / static_cast<double>(a.mesh.vertices.size()));
  RecordProperty("rms_px", std::to_string(rms));
  RecordProperty("worst_px", std::to_string(worst));
  EXPECT_LT(rms, 0.02);
  EXPECT_LT(worst, 0.5);  // whether one more pixel counts or not is a matter of rounding
}

INSTANTIATE_TEST_SUITE_P(Factors, UnitOfLengthTest, testing::Values(1000.0, 0.001));

/// The same start, seen by cameras of 240 x 180 pixels divided by `shrink`.
RefinementResult refine_ball(const TriangleMesh& start, int shrink) {
  const PinholeCamera camera = test::make_camera(240 / shrink, 180 / shrink, 220.0 / shrink);
  const test::Surface surface = test::sphere_surface(test::kBallRadius);
  std::vector<LabeledView> views = test::cast_views(
      test::arc_of_views(camera, {0.0, 0.0, test::kBallRadius}, 2.5, test::kArcStepDeg, 3),
      surface,
      0.3);
  test::segment(surface, half, &views);
  return refine(start, views, LabelSet(), {});
}

bool is_inside(const Eigen::Vector3d& v) {
  return v.z() > 0.0 && std::abs(v.x()) < 0.6 && std::abs(v.y()) < 0.5;
}

/// Facets whose class is not that of the true surface.
double wrong_share(const TriangleMesh& mesh) {
  double wrong = 0.0;
  double all = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const Eigen::Vector3d center =
        (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    const double area = is_inside(center) ? facet_cross(mesh, f).norm() : 0.0;
    wrong += mesh.labels[f] == half(center) ? 0.0 : area;
    all += area;
  }
  return wrong / all;
}

TEST(ImageSize, HalvedImagesGiveTheSameShapeAndClasses) {
  const Scene scene = test::bumpy_ball(4);
  const TriangleMesh whole = refine_ball(scene.mesh, 1).mesh;
  const TriangleMesh halved = refine_ball(scene.mesh, 2).mesh;
  double worst = 0.0;
  for (const Eigen::Vector3d& v : halved.vertices) {
    if (is_inside(v)) {
      worst = std::max(worst, test::nearest_facet(v, whole).distance);
    }
  }
  const double worst_px = 0.5 * scene.parallax_px_per_m * worst;  // of the smaller images
  RecordProperty("worst_px", std::to_string(worst_px));
  RecordProperty("error_px", std::to_string(test::ball_error_px(scene, whole)));
  RecordProperty("error_halved_px", std::to_string(test::ball_error_px(scene, halved)));
  RecordProperty("wrong", std::to_string(wrong_share(whole)));
  RecordProperty("wrong_halved", std::to_string(wrong_share(halved)));
  EXPECT_LT(worst_px, 0.15);
  EXPECT_LT(wrong_share(whole), 0.02);
  EXPECT_LT(wrong_share(halved), 0.03);
}

}  // namespace
}  // namespace facet_mapping
