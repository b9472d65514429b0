// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Feature tracks of the left camera against LiDAR depth on a real street.
#include <cmath>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/points/track_points.h"

namespace facet_mapping {
namespace {

constexpr int kFrames = 16;
constexpr double kMetresPerUnit = 1.0 / 256.0;

struct Shares {
  std::size_t points = 0;
  double within_1 = 0.0;
  double within_3 = 0.0;
  double within_5 = 0.0;

  void add(double depth, double truth) {
    const double error = std::abs(depth - truth) / truth;
    ++points;
    within_1 += error <= 0.01 ? 1.0 : 0.0;
    within_3 += error <= 0.03 ? 1.0 : 0.0;
    within_5 += error <= 0.05 ? 1.0 : 0.0;
  }

  void divide() {
    for (double* share : {&within_1, &within_3, &within_5}) {
      *share /= static_cast<double>(points);
    }
  }
};

void compare(const PointFrame& frame,
             const PinholeCamera& camera,
             const cv::Mat& true_depth,
             Shares* shares) {
  for (const LabeledPoint& point : frame.points) {
    const Eigen::Vector2d pixel = camera.project(point.position.cast<double>());
    const cv::Point nearest(static_cast<int>(std::lround(pixel.x())),
                            static_cast<int>(std::lround(pixel.y())));
    if (!cv::Rect(0, 0, true_depth.cols, true_depth.rows).contains(nearest)) {
      continue;
    }
    const double truth = true_depth.at<std::uint16_t>(nearest) * kMetresPerUnit;
    if (truth > 0.0) {
      shares->add(point.position.z(), truth);
    }
  }
}

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
    const std::string name = frame.left_image.substr(frame.left_image.rfind('/'));
    const cv::Mat depth = cv::imread(folder + "/gt_depth" + name, cv::IMREAD_UNCHANGED);
    points += frames[k].points.size();
    if (!depth.empty()) {
      compare(frames[k], frame.view.camera, depth, &shares);
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
