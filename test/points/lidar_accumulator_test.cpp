// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Packets become frames without losing a point or a time.
#include "facet_mapping/points/lidar_accumulator.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

/// Three points, the last at the packet's end; its x tells the time of measurement.
LidarScan packet(double stamp, double length = 0.01) {
  LidarScan scan;
  scan.stamp = stamp;
  for (const double offset : {0.0, 0.5 * length, length}) {
    scan.offsets_s.push_back(offset);
    scan.points.emplace_back(static_cast<float>(stamp + offset), 0.0F, 0.0F);
  }
  return scan;
}

void expect_times_kept(const LidarScan& frame) {
  ASSERT_EQ(frame.points.size(), frame.offsets_s.size());
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    EXPECT_NEAR(frame.points[i].x(), frame.stamp + frame.offsets_s[i], 1e-5);
  }
}

TEST(ScanAccumulator, GathersPacketsIntoFrames) {
  ScanAccumulator accumulator(0.1);
  std::size_t points = 0;
  std::size_t frames = 0;
  const auto take = [&](const LidarScan& frame) {
    ++frames;
    points += frame.points.size();
    EXPECT_EQ(frame.points.size(), 30U);
    expect_times_kept(frame);
    const double in_frame = std::fmod(frame.stamp - 5.0 + 1e-6, 0.1);
    EXPECT_GT(in_frame, 0.03) << "a stamp in the frame's middle";
    EXPECT_LT(in_frame, 0.06);
  };
  for (int i = 0; i < 35; ++i) {
    if (const auto frame = accumulator.add(packet(5.0 + 0.01 * i))) {
      take(*frame);
    }
  }
  EXPECT_EQ(frames, 3U);
  const auto rest = accumulator.finish();
  ASSERT_TRUE(rest.has_value());
  EXPECT_EQ(points + rest->points.size(), 35U * 3U);
  EXPECT_FALSE(accumulator.finish().has_value());
}

TEST(ScanAccumulator, ScanOfAFramesLengthPassesAsItIs) {
  ScanAccumulator none(0.0);
  const auto frame = none.add(packet(5.0));
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->stamp, 5.0);
  EXPECT_EQ(frame->offsets_s, packet(5.0).offsets_s);
  ScanAccumulator whole(0.1);
  EXPECT_FALSE(whole.add(packet(5.0, 0.1)).has_value());
  const auto first = whole.add(packet(5.1, 0.1));
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->stamp, 5.0);
  EXPECT_EQ(first->points.size(), 3U);
}

TEST(ScanAccumulator, PacketsWithoutTimesAreOfTheirStamps) {
  ScanAccumulator accumulator(0.1);
  for (const double stamp : {5.0, 5.04, 5.08}) {
    LidarScan scan = packet(stamp, 0.0);
    scan.offsets_s.clear();
    EXPECT_FALSE(accumulator.add(scan).has_value());
  }
  const auto frame = accumulator.finish();
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->points.size(), 9U);
  EXPECT_EQ(frame->stamp, 5.04);
  expect_times_kept(*frame);
}

TEST(ScanAccumulator, GapsAndStepsBackEndAFrame) {
  ScanAccumulator accumulator(0.1);
  EXPECT_FALSE(accumulator.add(packet(5.0)).has_value());
  auto frame = accumulator.add(packet(9.0));
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->stamp, 5.0);
  frame = accumulator.add(packet(2.0));
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->stamp, 9.0);
  accumulator.clear();
  EXPECT_FALSE(accumulator.finish().has_value());
}

TEST(ScanAccumulator, RefusesWhatDoesNotFit) {
  EXPECT_THROW(ScanAccumulator(-1.0), std::invalid_argument);
  EXPECT_THROW(ScanAccumulator(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  LidarScan scan = packet(5.0);
  scan.offsets_s.pop_back();
  ScanAccumulator accumulator(0.1);
  EXPECT_THROW(accumulator.add(scan), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
