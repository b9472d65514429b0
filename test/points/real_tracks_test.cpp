// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Feature tracks of the left camera against LiDAR depth on a real street.
#include <cmath>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include "true_depth.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/points/track_points.h"

namespace facet_mapping {
namespace {

constexpr int kFrames = 16;

using test::compare;
using test::Shares;

TEST(RealTracks, PointsOfOneCameraAgreeWithLidar) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  FeatureTracker tracker;
  std::vector<PointFrame> frames;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const DatasetFrame& frame = dataset.frames.at(k);
    for (PointFrame& done : tracker.add(
             cv::imread(frame.left_image, cv::IMREAD_GRAYSCALE), frame.view, {}, frame.stamp)) {
      frames.push_back(std::move(done));
    }
  }
  ASSERT_EQ(frames.size(), 8U);
  Shares shares;
  std::size_t points = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const DatasetFrame& frame = dataset.frames[k];
    ASSERT_EQ(frames[k].stamp, frame.stamp);
    points += frames[k].points.size();
    if (!frame.gt_depth.empty()) {
      compare(
          frames[k], frame.view.camera, read_depth(frame.gt_depth, dataset.depth_scale), &shares);
    }
  }
  ASSERT_GT(shares.points, 500U);
  shares.divide();
  RecordProperty("points_per_frame", static_cast<int>(points / frames.size()));
  EXPECT_GT(points / frames.size(), 800U);
  EXPECT_GT(shares.within_1, 0.4);
  EXPECT_GT(shares.within_3, 0.7);
  EXPECT_GT(shares.within_5, 0.8);
}

}  // namespace
}  // namespace facet_mapping
