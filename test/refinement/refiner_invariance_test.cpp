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

constexpr double kRelief = 5.0;  // radians per metre

double relief(double x, double y) {
  return 0.06 * std::sin(kRelief * x + 0.5) * std::cos(kRelief * y - 0.8);
}

/// Rays from above to the relief.
test::Surface relief_surface() {
  return [](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    double t = -origin.z() / direction.z();
    for (int k = 0; k < 30; ++k) {
      const Eigen::Vector3d p = origin + t * direction;
      t -= (p.z() - relief(p.x(), p.y())) / direction.z();
    }
    return std::optional<Eigen::Vector3d>(origin + t * direction);
  };
}

/// A plane as the start, seen by cameras of 240 x 180 pixels divided by `shrink`.
TriangleMesh refine_relief(int shrink) {
  const PinholeCamera camera = test::make_camera(240 / shrink, 180 / shrink, 300.0 / shrink);
  std::vector<LabeledView> views = test::cast_views(
      test::arc_of_views(camera, Eigen::Vector3d::Zero(), 3.0, test::kArcStepDeg, 3),
      relief_surface(),
      0.3);
  test::segment(relief_surface(), half, &views);
  return refine(test::make_grid_plane(30, 24, 0.07), views, LabelSet(), {}).mesh;
}

bool is_inside(const Eigen::Vector3d& v) {
  return std::abs(v.x()) < 0.8 && std::abs(v.y()) < 0.6;
}

/// Share of the surface whose class is not that of the true surface.
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
  const TriangleMesh whole = refine_relief(1);
  const TriangleMesh halved = refine_relief(2);
  const double px_per_m = 150.0 / 3.0 * std::sin(test::kArcStepDeg * M_PI / 180.0);
  const auto to_truth = [](const Eigen::Vector3d& v) { return v.z() - relief(v.x(), v.y()); };
  const auto to_whole = [&](const Eigen::Vector3d& v) {
    return test::nearest_facet(v, whole).distance;
  };
  const double start =
      test::rms_px(test::make_grid_plane(30, 24, 0.07), px_per_m, is_inside, to_truth);
  const double apart = test::rms_px(halved, px_per_m, is_inside, to_whole);
  RecordProperty("start", std::to_string(start));
  RecordProperty("error", std::to_string(test::rms_px(whole, px_per_m, is_inside, to_truth)));
  RecordProperty("error_halved",
                 std::to_string(test::rms_px(halved, px_per_m, is_inside, to_truth)));
  RecordProperty("apart", std::to_string(apart));
  RecordProperty("wrong", std::to_string(wrong_share(whole)));
  RecordProperty("wrong_halved", std::to_string(wrong_share(halved)));
  EXPECT_GT(start, 0.15);
  EXPECT_LT(apart, 0.03);
  EXPECT_LT(wrong_share(whole), 0.02);
  EXPECT_LT(wrong_share(halved), 0.03);
}

}  // namespace
}  // namespace facet_mapping
