// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/scan_depth.h"

#include <cmath>
#include <stdexcept>

#include "support/shared_data.h"
#include <gtest/gtest.h>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {
namespace {

// The scanner's x points along the camera's z, its y to the left, its z up.
Eigen::Isometry3d cam_from_scanner() {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return transform;
}

const PinholeCamera kCamera{80, 60, 50.0, 50.0, 40.0, 30.0};

cv::Mat depth_of(const std::vector<Eigen::Vector4f>& points) {
  return scan_depth(points, cam_from_scanner(), kCamera);
}

TEST(ScanDepth, PointsFallOnTheirPixels) {
  // 10 m ahead, 2 m left, 1 m up: column 40 - 50 * 2/10, row 30 - 50 * 1/10.
  const cv::Mat depth = depth_of({{10, 2, 1, 0}, {5, 0, 0, 0}});
  EXPECT_EQ(depth.at<float>(25, 30), 10.0F);
  EXPECT_EQ(depth.at<float>(30, 40), 5.0F);
  EXPECT_EQ(cv::countNonZero(depth), 2);
}

TEST(ScanDepth, TheNearestPointOfAPixelStays) {
  const cv::Mat depth = depth_of({{10, 0, 0, 0}, {9.5, 0, 0, 0}, {11, 0, 0, 0}});
  EXPECT_EQ(depth.at<float>(30, 40), 9.5F);
  EXPECT_EQ(cv::countNonZero(depth), 1);
}

TEST(ScanDepth, PointsBesideAClearlyNearerOneAreOccluded) {
  // Two columns apart: 10 m stands behind 5 m; 10 m beside 9 m is the same surface.
  const cv::Mat occluded = depth_of({{5, 0, 0, 0}, {10, -0.4F, 0, 0}});
  EXPECT_EQ(occluded.at<float>(30, 40), 5.0F);
  EXPECT_EQ(cv::countNonZero(occluded), 1);
  const cv::Mat surface = depth_of({{9, 0, 0, 0}, {10, -0.4F, 0, 0}});
  EXPECT_EQ(cv::countNonZero(surface), 2);
  const cv::Mat far_away = depth_of({{5, 0, 0, 0}, {10, -3, 0, 0}});
  EXPECT_EQ(cv::countNonZero(far_away), 2);
}

TEST(ScanDepth, UselessPointsAreSkipped) {
  const float nan = std::nanf("");
  const cv::Mat depth = depth_of({{-5, 0, 0, 0},
                                  {0, 0, 0, 0},
                                  {nan, 0, 0, 0},
                                  {5, nan, 0, 0},
                                  {5, 100, 0, 0},
                                  {5, 0, -100, 0}});
  EXPECT_EQ(cv::countNonZero(depth), 0);
  EXPECT_THROW(scan_depth({}, cam_from_scanner(), PinholeCamera()), std::invalid_argument);
}

// The provider's depth images are of the same scans, with occluded points removed.
TEST(ScanDepth, AgreesWithTheProvidersDepthImages) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  const DatasetFrame& frame = dataset.frames[20];
  const cv::Mat truth = read_depth(frame.gt_depth, dataset.depth_scale);
  const cv::Mat depth =
      scan_depth(read_scan(frame.scan), dataset.left_from_velo, frame.view.camera);
  cv::Mat difference;
  cv::absdiff(truth, depth, difference);
  const cv::Mat both = (truth > 0) & (depth > 0);
  double largest = 0.0;
  cv::minMaxLoc(difference, nullptr, &largest, nullptr, nullptr, both);
  EXPECT_LT(largest, 0.01);
  EXPECT_GT(cv::countNonZero(both), 0.97 * cv::countNonZero(truth));
  EXPECT_LT(cv::countNonZero(depth), 1.12 * cv::countNonZero(truth));
}

}  // namespace
}  // namespace facet_mapping
