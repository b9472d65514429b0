// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/view_pairs.h"

#include <algorithm>
#include <cmath>

#include "support/meshes.h"
#include "textured_scene.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

std::vector<std::vector<int>> pairs_of(const TriangleMesh& mesh,
                                       const std::vector<View>& views,
                                       int count) {
  ViewPairConfig config;
  config.pairs_per_view = count;
  return select_view_pairs(mesh, views, render_surfaces(mesh, views, 0.15), config);
}

TEST(ViewPairs, ParallaxIsBestAtTenDegrees) {
  EXPECT_EQ(parallax_score(0.0, 10.0), 0.0);
  EXPECT_NEAR(parallax_score(10.0, 10.0), 1.0, 1e-12);
  for (double angle = 1.0; angle < 10.0; angle += 1.0) {
    EXPECT_LT(parallax_score(angle, 10.0), parallax_score(angle + 1.0, 10.0));
    EXPECT_GT(parallax_score(angle + 10.0, 10.0), parallax_score(angle + 11.0, 10.0));
  }
}

TEST(ViewPairs, PrefersTheBestParallaxOnAnArc) {
  const TriangleMesh plane = test::make_grid_plane(20, 20, 0.1);
  const PinholeCamera camera = test::make_camera(160, 120, 200.0);
  const std::vector<View> views = test::arc_of_views(camera, Eigen::Vector3d::Zero(), 3.0, 2.0, 15);
  const std::vector<std::vector<int>> partners = pairs_of(plane, views, 2);
  for (int i = 0; i < 15; ++i) {
    ASSERT_EQ(partners[i].size(), 2U);
    for (const int j : partners[i]) {
      const double angle = 2.0 * std::abs(i - j);
      EXPECT_GE(angle, 6.0);
      EXPECT_LE(angle, 16.0);
    }
  }
}

/// A corridor: neighbouring frames hardly differ, far ones see the walls from far away.
TEST(ViewPairs, ForwardDriveTakesFramesSomeMetresApart) {
  TriangleMesh street = test::make_grid_plane(40, 80, 0.5);  // road, 20 m x 40 m
  TriangleMesh wall = test::make_grid_plane(40, 80, 0.5);
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitY()).toRotationMatrix();
  turn.translation() = Eigen::Vector3d(5.0, 0.0, 0.0);
  street = test::joined(street, test::transformed(wall, turn));
  turn.translation() = Eigen::Vector3d(-5.0, 0.0, 0.0);
  street = test::joined(street, test::transformed(wall, turn));
  const PinholeCamera camera = test::make_camera(300, 100, 180.0);
  std::vector<View> views;
  for (int k = 0; k < 12; ++k) {
    const Eigen::Vector3d eye(0.0, -15.0 + 0.5 * k, 1.6);
    views.push_back(test::look_at(camera, eye, eye + Eigen::Vector3d(0.0, 10.0, -0.3)));
  }
  for (const std::vector<int>& list : pairs_of(street, views, 3)) {
    EXPECT_EQ(list.size(), 3U);
  }
  const std::vector<int> of_first = pairs_of(street, views, 3)[0];
  EXPECT_GE(*std::max_element(of_first.begin(), of_first.end()), 3);
}

TEST(ViewPairs, NoPartnerWithoutCommonSurface) {
  const TriangleMesh sphere = test::make_sphere(1.0, 4);
  const PinholeCamera camera = test::make_camera(100, 100, 100.0);
  const std::vector<View> views = {
      test::look_at(camera, {4.0, 0.0, 0.0}, {0.0, 0.0, 0.0}),
      test::look_at(camera, {-4.0, 0.0, 0.0}, {0.0, 0.0, 0.0}),
      test::look_at(camera, {4.0, 0.8, 0.0}, {0.0, 0.0, 0.0}),
  };
  const std::vector<std::vector<int>> partners = pairs_of(sphere, views, 3);
  EXPECT_EQ(partners[0], std::vector<int>{2});
  EXPECT_TRUE(partners[1].empty());
  EXPECT_EQ(partners[2], std::vector<int>{0});
}

}  // namespace
}  // namespace facet_mapping
