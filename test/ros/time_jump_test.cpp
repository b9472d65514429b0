// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/time_jump.h"

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

TEST(TimeJump, JitterIsNoJump) {
  TimeJumpDetector detector(1.0);
  EXPECT_FALSE(detector.jumped_back("a", ros::Time(10.0)));
  EXPECT_FALSE(detector.jumped_back("a", ros::Time(9.5)));
  EXPECT_FALSE(detector.jumped_back("a", ros::Time(9.6)));
}

TEST(TimeJump, OneJumpIsReportedOnce) {
  TimeJumpDetector detector(1.0);
  detector.jumped_back("a", ros::Time(100.0));
  detector.jumped_back("b", ros::Time(100.0));
  EXPECT_TRUE(detector.jumped_back("a", ros::Time(10.0)));
  EXPECT_DOUBLE_EQ(detector.jump_s(), 90.0);
  EXPECT_FALSE(detector.jumped_back("b", ros::Time(10.0)));
  EXPECT_FALSE(detector.jumped_back("a", ros::Time(10.1)));
}

TEST(TimeJump, SourcesOfDifferentLatencyDoNotDisturbEachOther) {
  TimeJumpDetector detector(1.0);
  for (int k = 0; k < 10; ++k) {
    EXPECT_FALSE(detector.jumped_back("lidar", ros::Time(100.0 + k)));
    EXPECT_FALSE(detector.jumped_back("camera", ros::Time(90.0 + k)));
  }
}

}  // namespace
}  // namespace facet_mapping
