// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Plane sweeping of single cameras against LiDAR depth on a real street and against a laser scan of
// a fountain.
#include <cmath>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include "true_depth.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/points/sweep_points.h"

namespace facet_mapping {
namespace {

using test::compare;
using test::Shares;

struct RealSweep {
  Shares shares;
  std::size_t points_per_frame = 0;
};

/// Sweeps `count` images at half size.
RealSweep sweep_half_size(const Dataset& dataset, std::size_t count, const SweepConfig& config) {
  PlaneSweeper sweeper(config);
  std::vector<PointFrame> frames;
  for (std::size_t k = 0; k < count; ++k) {
    const DatasetFrame& frame = dataset.frames.at(k);
    cv::Mat gray = read_gray(frame.left_image);
    View view = frame.view;
    view.camera = view.camera.resized(gray.cols / 2, gray.rows / 2);
    cv::resize(gray, gray, {gray.cols / 2, gray.rows / 2}, 0.0, 0.0, cv::INTER_AREA);
    for (PointFrame& done : sweeper.add(gray, view, {}, frame.stamp)) {
      frames.push_back(std::move(done));
    }
  }
  for (PointFrame& done : sweeper.finish()) {
    frames.push_back(std::move(done));
  }
  EXPECT_EQ(frames.size(), count);
  RealSweep result;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const DatasetFrame& frame = dataset.frames[k];
    result.points_per_frame += frames[k].points.size() / frames.size();
    if (!frame.gt_depth.empty()) {
      compare(frames[k],
              frame.view.camera,
              read_depth(frame.gt_depth, dataset.depth_scale),
              &result.shares);
    }
  }
  result.shares.divide();
  return result;
}

TEST(RealSweep, PointsOfOneCameraAgreeWithLidar) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const RealSweep found = sweep_half_size(read_dataset(folder), 5, {});
  RecordProperty("points_per_frame", static_cast<int>(found.points_per_frame));
  EXPECT_GT(found.points_per_frame, 1000U);
  ASSERT_GT(found.shares.points, 200U);
  EXPECT_GT(found.shares.within_1, 0.5);
  EXPECT_GT(found.shares.within_3, 0.8);
  EXPECT_GT(found.shares.within_5, 0.88);
}

TEST(RealSweep, PointsOfWideBaselinesAgreeWithTheLaser) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "fountain_p11");
  SweepConfig config;
  config.sweep_width_px = 400;
  config.min_depth_m = 4.0;
  config.max_depth_m = 20.0;
  const RealSweep found = sweep_half_size(read_dataset(folder), 4, config);
  RecordProperty("points_per_frame", static_cast<int>(found.points_per_frame));
  EXPECT_GT(found.points_per_frame, 4000U);
  EXPECT_GT(found.shares.within_1, 0.9);
  EXPECT_GT(found.shares.within_3, 0.97);
  EXPECT_GT(found.shares.within_5, 0.98);
}

}  // namespace
}  // namespace facet_mapping
