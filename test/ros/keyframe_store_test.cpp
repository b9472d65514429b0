// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/keyframe_store.h"

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

constexpr std::size_t kImageBytes = 100;

LabeledView view_at(double x) {
  LabeledView view;
  view.gray = cv::Mat::zeros(10, 10, CV_8UC1);
  view.view.world_from_cam.translation().x() = x;
  return view;
}

Eigen::Isometry3d pose(double x, double turn_deg) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(turn_deg * M_PI / 180.0, Eigen::Vector3d::UnitY()));
  pose.translation().x() = x;
  return pose;
}

TEST(KeyframeStore, MotionOrRotationMakesAKeyframe) {
  KeyframeStore store({0.5, 10.0, 100, 1 << 20});
  EXPECT_TRUE(store.wants(pose(0.0, 0.0)));
  store.add(view_at(0.0));
  EXPECT_FALSE(store.wants(pose(0.4, 9.0)));
  EXPECT_TRUE(store.wants(pose(0.6, 0.0)));
  EXPECT_TRUE(store.wants(pose(0.0, 11.0)));
}

TEST(KeyframeStore, TheOldestGoFirst) {
  KeyframeStore store({0.5, 10.0, 3, 1 << 20});
  std::size_t dropped = 0;
  for (int k = 0; k < 5; ++k) {
    dropped += store.add(view_at(k));
  }
  EXPECT_EQ(dropped, 2U);
  EXPECT_EQ(store.views().front().view.center().x(), 2.0);
  EXPECT_EQ(store.newest()->view.center().x(), 4.0);
}

TEST(KeyframeStore, MemoryIsBounded) {
  KeyframeStore store({0.5, 10.0, 100, 5 * kImageBytes});
  for (int k = 0; k < 20; ++k) {
    store.add(view_at(k));
    EXPECT_LE(store.bytes(), 5 * kImageBytes);
  }
  EXPECT_EQ(store.size(), 5U);
  store.clear();
  EXPECT_EQ(store.bytes(), 0U);
  EXPECT_FALSE(store.newest().has_value());
}

TEST(KeyframeStore, TwoViewsStayWhateverTheyWeigh) {
  KeyframeStore store({0.5, 10.0, 100, 1});
  for (int k = 0; k < 4; ++k) {
    store.add(view_at(k));
  }
  EXPECT_EQ(store.size(), 2U);
}

TEST(KeyframeStore, LabelledViewsAreCounted) {
  KeyframeStore store{KeyframeLimits()};
  store.add(view_at(0.0));
  LabeledView view = view_at(1.0);
  view.labels = cv::Mat::zeros(10, 10, CV_16UC1);
  store.add(view);
  EXPECT_EQ(store.labelled(), 1U);
}

}  // namespace
}  // namespace facet_mapping
