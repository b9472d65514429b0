// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/stamp_sync.h"

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

constexpr double kCacheS = 5.0;
constexpr double kSegmentationWaitS = 2.0;

enum Part { kLeft, kRight, kSegmentation };

class StampSyncTest : public testing::Test {
 protected:
  std::vector<StampedParts> add(Part part, double stamp, double now) {
    return sync_.add(
        part, ros::Time(stamp), boost::make_shared<const int>(part), ros::WallTime(now));
  }
  std::vector<StampedParts> poll(double now) { return sync_.poll(ros::WallTime(now)); }

  StampSync sync_{{{"left"}, {"right"}, {"segmentation", false, kSegmentationWaitS}}, kCacheS, 3};
};

TEST_F(StampSyncTest, CompleteFrameGoesOnAtOnce) {
  EXPECT_TRUE(add(kLeft, 10.0, 1.0).empty());
  EXPECT_TRUE(add(kSegmentation, 10.0, 1.0).empty());
  const auto ready = add(kRight, 10.0, 1.1);
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_EQ(ready[0].stamp, ros::Time(10.0));
  EXPECT_EQ(*ready[0].get<int>(kRight), kRight);
  EXPECT_EQ(sync_.waiting(), 0U);
}

TEST_F(StampSyncTest, LateSegmentationStillPairs) {
  add(kLeft, 10.0, 1.0);
  EXPECT_TRUE(add(kRight, 10.0, 1.0).empty());
  EXPECT_TRUE(poll(2.9).empty());
  const auto ready = add(kSegmentation, 10.0, 2.95);
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_NE(ready[0].parts[kSegmentation], nullptr);
}

TEST_F(StampSyncTest, FrameGoesOnWithoutSegmentationAfterTheWait) {
  add(kLeft, 10.0, 1.0);
  add(kRight, 10.0, 1.5);
  EXPECT_TRUE(poll(3.4).empty());  // the wait counts from the last required part
  const auto ready = poll(3.6);
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_EQ(ready[0].parts[kSegmentation], nullptr);
  EXPECT_EQ(sync_.counts().missing[kSegmentation], 1U);
  EXPECT_TRUE(add(kSegmentation, 10.0, 4.0).empty());
  EXPECT_EQ(sync_.counts().late, 1U);
}

TEST_F(StampSyncTest, OtherStampsNeverPair) {
  add(kLeft, 10.0, 1.0);
  add(kSegmentation, 10.0, 1.0);
  EXPECT_TRUE(add(kRight, 10.000001, 1.0).empty());
  EXPECT_TRUE(poll(6.5).empty());
  EXPECT_EQ(sync_.counts().unpaired, 2U);
  EXPECT_EQ(sync_.waiting(), 0U);
}

TEST_F(StampSyncTest, FramesComeInOrderOfTheirStamps) {
  add(kLeft, 11.0, 1.0);
  add(kLeft, 10.0, 1.0);
  add(kRight, 11.0, 1.0);
  add(kRight, 10.0, 1.0);
  const auto ready = poll(3.1);
  ASSERT_EQ(ready.size(), 2U);
  EXPECT_LT(ready[0].stamp, ready[1].stamp);
}

TEST_F(StampSyncTest, APartOfALaterStampEndsTheWaitForAnEarlierOne) {
  add(kLeft, 10.0, 1.0);
  add(kRight, 10.0, 1.0);
  add(kLeft, 11.0, 1.1);
  EXPECT_TRUE(add(kRight, 11.0, 1.1).empty());
  const auto ready = add(kSegmentation, 11.0, 1.2);  // a network that dropped the first image
  ASSERT_EQ(ready.size(), 2U);
  EXPECT_EQ(ready[0].stamp, ros::Time(10.0));
  EXPECT_EQ(ready[0].parts[kSegmentation], nullptr);
  EXPECT_NE(ready[1].parts[kSegmentation], nullptr);
}

TEST_F(StampSyncTest, TheOldestIsDroppedWhenFull) {
  for (int k = 0; k < 4; ++k) {
    add(kLeft, 10.0 + k, 1.0);
  }
  EXPECT_EQ(sync_.waiting(), 3U);
  EXPECT_EQ(sync_.counts().unpaired, 1U);
}

TEST_F(StampSyncTest, AfterClearTheSameStampPairsAgain) {
  for (int pass = 0; pass < 2; ++pass) {
    add(kLeft, 10.0, 1.0);
    add(kRight, 10.0, 1.0);
    EXPECT_EQ(add(kSegmentation, 10.0, 1.0).size(), 1U);
    sync_.clear();
  }
  EXPECT_EQ(sync_.counts().late, 0U);
}

}  // namespace
}  // namespace facet_mapping
