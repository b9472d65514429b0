// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The proposed method, photometric and semantic flow together, returns perturbed shapes to the
// truth.
#include "refine_scenes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

constexpr double kGoalPx = 0.2;

/// Stripes of two classes, narrow enough that their borders pull on much of the surface.
Label stripe(const Eigen::Vector3d& point) {
  return std::sin(8.0 * point.x() + 2.0 * point.y()) > 0.0 ? 1 : 2;
}

class RecoveryTest : public testing::TestWithParam<SemanticMode> {
 protected:
  RefinementConfig config() const {
    RefinementConfig config;
    config.semantic = GetParam();
    return config;
  }
};

TEST_P(RecoveryTest, PlaneReturnsToTheTruth) {
  test::Scene scene = test::wavy_plane();
  test::segment(test::plane_surface(), stripe, &scene.views);
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config());
  const double before = test::plane_error_px(scene, scene.mesh);
  const double after = test::plane_error_px(scene, result.mesh);
  RecordProperty("rms_px_before", std::to_string(before));
  RecordProperty("rms_px_after", std::to_string(after));
  EXPECT_GT(before, 1.5 * kGoalPx);
  EXPECT_LT(after, kGoalPx);
}

TEST_P(RecoveryTest, BallReturnsToTheTruth) {
  test::Scene scene = test::bumpy_ball(5);
  test::segment(test::sphere_surface(test::kBallRadius), stripe, &scene.views);
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config());
  const double before = test::ball_error_px(scene, scene.mesh);
  const double after = test::ball_error_px(scene, result.mesh);
  RecordProperty("rms_px_before", std::to_string(before));
  RecordProperty("rms_px_after", std::to_string(after));
  EXPECT_GT(before, 1.2 * kGoalPx);
  EXPECT_LT(after, kGoalPx);
}

INSTANTIATE_TEST_SUITE_P(Modes,
                         RecoveryTest,
                         testing::Values(SemanticMode::kNormal, SemanticMode::kFull));

}  // namespace
}  // namespace facet_mapping
