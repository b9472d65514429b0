// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/labeled_map.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

LabelSet two_classes() {
  ClassInfo road;
  road.id = 0;
  road.name = "road";
  road.color = {128, 64, 128};
  ClassInfo car;
  car.id = 13;
  car.name = "car";
  car.color = {0, 0, 142};
  car.dynamic = true;
  return LabelSet({road, car});
}

/// Points on a plane 2 m in front of a sensor at x = `x_m` that looks along z.
PointFrame plane_frame(double x_m, Label label = 0) {
  PointFrame frame;
  frame.stamp = 10.0 + x_m;
  frame.world_from_sensor.translation().x() = x_m;
  for (int k = 0; k < 400; ++k) {
    const auto u = static_cast<float>(k % 20 - 10);
    const auto v = static_cast<float>(k / 20 - 10);
    frame.points.push_back(
        {{0.1F * u + 0.003F * v, 0.1F * v, 2.0F + 0.001F * u * v}, label, 0.01F});
  }
  return frame;
}

TEST(LabeledMap, BuildsALabelledClosedSurface) {
  LabeledMap map(two_classes(), MapConfig{});
  EXPECT_FALSE(map.update());
  for (int k = 0; k < 3; ++k) {
    const FrameReport report = map.add(plane_frame(k));
    EXPECT_TRUE(report.keyframe);
    EXPECT_EQ(report.used, 400U);
  }
  EXPECT_EQ(map.pending(), 3U);
  EXPECT_TRUE(map.update());
  EXPECT_EQ(map.pending(), 0U);
  EXPECT_EQ(map.keyframes(), 3U);
  EXPECT_DOUBLE_EQ(map.last_stamp(), 12.0);
  EXPECT_TRUE(check_manifold(map.mesh()).is_closed_manifold());
  std::size_t road = 0;
  for (const Label label : map.mesh().labels) {
    road += label == 0 ? 1 : 0;
  }
  EXPECT_GT(road, 500U);
}

TEST(LabeledMap, AStandingSensorAddsNoKeyframes) {
  LabeledMap map(two_classes(), MapConfig{});
  EXPECT_TRUE(map.add(plane_frame(0.0)).keyframe);
  EXPECT_FALSE(map.add(plane_frame(0.1)).keyframe);
  EXPECT_TRUE(map.add(plane_frame(0.1), "another sensor").keyframe);
  PointFrame turned = plane_frame(0.1);
  turned.world_from_sensor.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(map.add(turned).keyframe);
}

TEST(LabeledMap, CountsWhatItDrops) {
  MapConfig config;
  config.dynamic = DynamicPolicy::kDrop;
  LabeledMap map(two_classes(), config);
  PointFrame frame = plane_frame(0.0);
  frame.points[0].position.x() = std::nanf("");
  frame.points[1].position.z() = 1000.0F;
  frame.points[2].label = 7;
  frame.points[3].label = 13;
  frame.points[4].label = kUnlabelled;
  const FrameReport report = map.add(frame);
  EXPECT_EQ(report.not_finite, 1U);
  EXPECT_EQ(report.out_of_range, 1U);
  EXPECT_EQ(report.unknown_label, 1U);
  EXPECT_EQ(report.dynamic_dropped, 1U);
  EXPECT_EQ(report.used, 397U);
}

TEST(LabeledMap, RefusesBrokenPosesAndLivesOn) {
  LabeledMap map(two_classes(), MapConfig{});
  PointFrame frame = plane_frame(0.0);
  frame.world_from_sensor.translation().y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map.add(frame), std::invalid_argument);
  frame = plane_frame(0.0);
  frame.world_from_sensor.linear() *= 2.0;
  EXPECT_THROW(map.add(frame), std::invalid_argument);
  EXPECT_TRUE(map.add(plane_frame(0.0)).keyframe);
  EXPECT_TRUE(map.update());
}

TEST(LabeledMap, ResetForgetsEverything) {
  LabeledMap map(two_classes(), MapConfig{});
  map.add(plane_frame(0.0));
  map.update();
  EXPECT_FALSE(map.mesh().empty());
  map.reset();
  EXPECT_TRUE(map.mesh().empty());
  EXPECT_EQ(map.keyframes(), 0U);
  EXPECT_TRUE(map.add(plane_frame(0.0)).keyframe);
}

TEST(LabeledMap, EmptyFramesAreHarmless) {
  LabeledMap map(two_classes(), MapConfig{});
  PointFrame frame;
  EXPECT_TRUE(map.add(frame).keyframe);
  EXPECT_TRUE(map.update());
  EXPECT_TRUE(map.mesh().empty());
}

}  // namespace
}  // namespace facet_mapping
