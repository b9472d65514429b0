// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/seen_points.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

/// A wall at z = 4 m of 5 x 5 vertices, and a smaller one at z = 8 m that hides behind it.
TriangleMesh two_walls() {
  TriangleMesh mesh;
  for (const double z : {4.0, 8.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int k = 0; k < 25; ++k) {
      mesh.vertices.emplace_back(0.4 * (k % 5 - 2), 0.4 * (k / 5 - 2), z);
    }
    for (std::uint32_t row = 0; row < 4; ++row) {
      for (std::uint32_t col = 0; col < 4; ++col) {
        const std::uint32_t a = first + 5 * row + col;
        mesh.triangles.push_back({a, a + 1, a + 5});
        mesh.triangles.push_back({a + 1, a + 6, a + 5});
      }
    }
  }
  return mesh;
}

View front_view() {
  View view;
  view.camera = {200, 200, 200.0, 200.0, 99.5, 99.5};
  return view;
}

TEST(SeenPoints, OnlyWhatTheCameraSees) {
  const TriangleMesh mesh = two_walls();
  SeenPoints points(mesh, {});
  const PointFrame frame = points.seen_from(front_view(), {});
  // The wall's outermost row and column lie on its silhouette, where a pixel may miss the mesh.
  EXPECT_GE(frame.points.size(), 9U);
  EXPECT_LE(frame.points.size(), 25U);
  for (const LabeledPoint& point : frame.points) {
    EXPECT_FLOAT_EQ(point.position.z(), 4.0F) << "a hidden point";
    EXPECT_EQ(point.label, kUnlabelled);
  }
  EXPECT_EQ(points.unseen(), mesh.vertices.size() - frame.points.size());
}

TEST(SeenPoints, PointsStandInTheCamerasFrame) {
  const TriangleMesh mesh = two_walls();
  SeenPoints points(mesh, {0.005, 0.02});
  View view = front_view();
  view.world_from_cam.linear() =
      Eigen::AngleAxisd(3.14159265358979, Eigen::Vector3d::UnitY()).toRotationMatrix();
  view.world_from_cam.translation() = Eigen::Vector3d(0.1, 0.2, 12.0);
  const PointFrame frame = points.seen_from(view, {});
  ASSERT_FALSE(frame.points.empty());
  for (const LabeledPoint& point : frame.points) {
    const Eigen::Vector3d world = frame.world_from_sensor * point.position.cast<double>();
    EXPECT_NEAR(world.z(), 8.0, 1e-5) << "from behind the second wall is seen";
    EXPECT_FLOAT_EQ(point.sigma, 0.02F);
  }
}

TEST(SeenPoints, TakeTheClassOfTheirPixel) {
  const TriangleMesh mesh = two_walls();
  SeenPoints points(mesh, {});
  const View view = front_view();
  cv::Mat labels(200, 200, CV_16UC1, cv::Scalar(3));
  labels.colRange(100, 200).setTo(7);
  for (const LabeledPoint& point : points.seen_from(view, labels).points) {
    if (std::abs(point.position.x()) > 0.1F) {
      EXPECT_EQ(point.label, point.position.x() > 0.0F ? 7 : 3);
    }
  }
}

TEST(SeenPoints, RefusesWhatDoesNotFit) {
  EXPECT_THROW(SeenPoints(TriangleMesh(), {}), std::invalid_argument);
  const TriangleMesh mesh = two_walls();
  SeenPoints points(mesh, {});
  EXPECT_THROW(points.seen_from(front_view(), cv::Mat(10, 10, CV_16UC1)), std::invalid_argument);
  EXPECT_THROW(points.seen_from(front_view(), cv::Mat(200, 200, CV_8UC1)), std::invalid_argument);
}

TEST(SeenPoints, MedianEdge) {
  EXPECT_EQ(median_edge(TriangleMesh()), 0.0);
  EXPECT_NEAR(median_edge(two_walls()), 0.4, 1e-12);
}

}  // namespace
}  // namespace facet_mapping
