// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/point_quality.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include "support/shared_data.h"
#include "support/small_datasets.h"
#include <gtest/gtest.h>

#include "facet_mapping/evaluation/point_report.h"

namespace facet_mapping {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
const PinholeCamera kCamera{kWidth, kHeight, 50.0, 50.0, 31.5, 23.5};

/// The point at a pixel and a planar depth.
LabeledPoint point_at(double x, double y, double depth, Label label = kUnlabelled) {
  LabeledPoint point;
  point.position = (depth * kCamera.ray({x, y})).cast<float>();
  point.label = label;
  return point;
}

/// A wall of this depth in front of a camera at the origin.
PointTruth wall(double depth) {
  return {{kCamera, Eigen::Isometry3d::Identity()},
          cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(depth)),
          {},
          {}};
}

PointFrame frame_of(std::vector<LabeledPoint> points) {
  return {0.0, Eigen::Isometry3d::Identity(), std::move(points)};
}

PointScores scores_of(const PointFrame& frame,
                      const PointTruth& truth,
                      const PointQualityOptions& options = {}) {
  PointQuality quality(options);
  quality.add(frame, truth);
  return quality.scores();
}

TEST(PointQuality, SharesWithinPartsOfTheDepth) {
  const PointFrame frame = frame_of({point_at(10, 10, 10.05),
                                     point_at(20, 10, 9.8),
                                     point_at(30, 10, 10.4),
                                     point_at(40, 10, 12.0)});
  const PointScores scores = scores_of(frame, wall(10.0));
  EXPECT_EQ(scores.points, 4U);
  EXPECT_EQ(scores.compared, 4U);
  EXPECT_DOUBLE_EQ(scores.within_relative.at(0), 0.25);
  EXPECT_DOUBLE_EQ(scores.within_relative.at(1), 0.5);
  EXPECT_DOUBLE_EQ(scores.within_relative.at(2), 0.75);
  EXPECT_NEAR(scores.mean_relative, (0.005 + 0.02 + 0.04 + 0.2) / 4.0, 1e-6);
  EXPECT_NEAR(scores.median_relative, 0.04, 1e-6);  // the upper one of the middle two
  EXPECT_NEAR(scores.median_error_m, 0.4, 1e-5);
}

TEST(PointQuality, ComparesWithThePixelThatThePointFallsOnAlone) {
  PointTruth truth = wall(0.0);
  truth.depth.at<float>(10, 20) = 10.0F;
  const PointScores scores = scores_of(frame_of({point_at(20.4, 9.6, 10.0),
                                                 point_at(20.6, 10.0, 10.0),
                                                 point_at(20.0, 10.6, 10.0),
                                                 point_at(-5.0, 10.0, 10.0),
                                                 point_at(20.0, 10.0, -10.0)}),
                                       truth);
  EXPECT_EQ(scores.points, 5U);
  EXPECT_EQ(scores.compared, 1U);
  EXPECT_DOUBLE_EQ(scores.compared_share, 0.2);
}

TEST(PointQuality, LooksFromWhereTheCameraIsNotFromTheSensor) {
  PointTruth truth = wall(8.0);
  truth.view.world_from_cam.translation() = Eigen::Vector3d(0.0, 0.0, 2.0);  // two metres ahead of the sensor
  const PointScores scores = scores_of(frame_of({point_at(31.5, 23.5, 10.0)}), truth);
  ASSERT_EQ(scores.compared, 1U);
  EXPECT_NEAR(scores.median_relative, 0.0, 1e-6);
}

TEST(PointQuality, PointsThatTheSensorItselfKnowsToBeHiddenAreNotCompared) {
  PointTruth truth = wall(10.0);
  truth.seen = cv::Mat::zeros(kHeight, kWidth, CV_32F);
  truth.seen.at<float>(10, 10) = 10.1F;  // the point itself
  truth.seen.at<float>(10, 20) = 5.0F;   // something in front
  const PointScores scores = scores_of(
      frame_of({point_at(10, 10, 10.1), point_at(20, 10, 10.0), point_at(30, 10, 10.0)}), truth);
  EXPECT_EQ(scores.compared, 1U);
  EXPECT_NEAR(scores.median_error_m, 0.1, 1e-5);
}

TEST(PointQuality, GaussianNoiseOfTheStatedSizeHasFactorOneAndTwiceOfItTwo) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  for (const double factor : {1.0, 2.0}) {
    std::vector<LabeledPoint> points;
    for (int k = 0; k < 20000; ++k) {
      const Eigen::Vector3d ray = kCamera.ray({(7 * k) % kWidth, (11 * k) % kHeight});
      LabeledPoint point;
      point.sigma = 0.02F;  // along the ray, not along the axis
      point.position =
          (10.0 * ray + 0.02 * factor * noise(random) * ray.normalized()).cast<float>();
      points.push_back(point);
    }
    const PointScores scores = scores_of(frame_of(points), wall(10.0));
    EXPECT_NEAR(scores.sigma_factor, factor, 0.03 * factor);
    EXPECT_NEAR(scores.within_sigma[0], std::erf(1.0 / factor / std::sqrt(2.0)), 0.01);
    EXPECT_NEAR(scores.within_sigma[2], std::erf(3.0 / factor / std::sqrt(2.0)), 0.01);
    EXPECT_NEAR(scores.mean_sigma_m, 0.02, 1e-6);
  }
}

TEST(PointQuality, PointsWithoutASigmaSayNothingAboutIt) {
  const PointScores scores = scores_of(frame_of({point_at(10, 10, 10.0)}), wall(10.0));
  EXPECT_EQ(scores.compared, 1U);
  EXPECT_TRUE(std::isnan(scores.sigma_factor));
  EXPECT_TRUE(std::isnan(scores.within_sigma[0]));
}

TEST(PointQuality, DensityCountsCellsWithTruth) {
  PointTruth truth = wall(0.0);
  truth.depth.at<float>(0, 0) = 10.0F;
  truth.depth.at<float>(0, 20) = 10.0F;
  truth.depth.at<float>(47, 63) = 10.0F;
  truth.depth.at<float>(20, 0) = 99.0F;  // beyond the limit
  PointQualityOptions options;
  options.max_depth_m = 50.0;
  const PointScores scores = scores_of(
      frame_of({point_at(5, 5, 10.0), point_at(40, 5, 10.0), point_at(3, 20, 10)}), truth, options);
  EXPECT_DOUBLE_EQ(scores.density, 1.0 / 3.0);
}

TEST(PointQuality, LabelsAgreeWhereBothHaveAClass) {
  PointTruth truth = wall(0.0);
  truth.labels = cv::Mat(kHeight, kWidth, CV_16U, cv::Scalar(2));
  truth.labels.at<Label>(10, 40) = kUnlabelled;
  const PointScores scores = scores_of(frame_of({point_at(10, 10, 10.0, 2),
                                                 point_at(20, 10, 10.0, 3),
                                                 point_at(30, 10, 10.0),
                                                 point_at(40, 10, 10.0, 2)}),
                                       truth);
  EXPECT_DOUBLE_EQ(scores.labelled_share, 0.75);
  EXPECT_EQ(scores.label_points, 2U);
  EXPECT_DOUBLE_EQ(scores.label_agreement, 0.5);
}

TEST(PointQuality, FramesWithoutTruthCountAsPointsAlone) {
  PointTruth truth = wall(10.0);
  truth.depth = cv::Mat();
  const PointScores scores = scores_of(frame_of({point_at(10, 10, 10.0)}), truth);
  EXPECT_EQ(scores.frames, 1U);
  EXPECT_EQ(scores.points, 1U);
  EXPECT_EQ(scores.compared, 0U);
  EXPECT_TRUE(std::isnan(scores.median_relative));
  EXPECT_TRUE(std::isnan(scores.within_relative.at(0)));
  EXPECT_TRUE(std::isnan(scores.density));
}

TEST(PointQuality, RefusesImagesThatDoNotFit) {
  PointQuality quality;
  PointTruth truth = wall(10.0);
  truth.depth = cv::Mat::zeros(kHeight, kWidth - 1, CV_32F);
  EXPECT_THROW(quality.add(frame_of({}), truth), std::invalid_argument);
  truth = wall(10.0);
  truth.labels = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  EXPECT_THROW(quality.add(frame_of({}), truth), std::invalid_argument);
  PointQualityOptions options;
  options.cell_px = 0;
  EXPECT_THROW(PointQuality{options}, std::invalid_argument);
}

TEST(PointQuality, AScanIsComparedWithTheNextFrameThatHasTruthOrTheOneBefore) {
  const testing::TempFolder folder;
  testing::make_plain(folder.path());
  Dataset dataset = read_dataset(folder.path());
  ASSERT_EQ(dataset.frames.size(), 3U);
  EXPECT_EQ(other_frame(dataset, 0), 1U);
  EXPECT_EQ(other_frame(dataset, 2), 1U);
  dataset.frames[1].gt_depth.clear();
  dataset.frames[1].scan.clear();
  EXPECT_EQ(other_frame(dataset, 0), 2U);
  dataset.frames.resize(1);
  EXPECT_THROW(other_frame(dataset, 0), std::invalid_argument);
}

TEST(PointQuality, RealScansAgreeWithTheNextFramesTruth) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  PointQuality quality;
  for (const std::size_t k : {3U, 24U}) {
    const DatasetFrame& frame = dataset.frames[k];
    PointFrame points{frame.stamp, frame.view.world_from_cam * dataset.left_from_velo, {}};
    for (const Eigen::Vector4f& hit : read_scan(frame.scan)) {
      points.points.push_back({hit.head<3>(), kUnlabelled, 0.03F});
    }
    quality.add(points, scan_truth(dataset, k, other_frame(dataset, k), {}));
  }
  const PointScores scores = quality.scores();
  EXPECT_GT(scores.compared, 1000U);
  EXPECT_GT(scores.within_relative.at(1), 0.95);
  EXPECT_GT(scores.median_error_m, 0.005);  // zero: compared with itself
  EXPECT_LT(scores.median_error_m, 0.08);
}

TEST(PointReport, HasAColumnPerSourceAndADashForWhatIsNotKnown) {
  PointQuality quality;
  quality.add(frame_of({point_at(10, 10, 10.05), point_at(20, 10, 10.4)}), wall(10.0));
  NamedPointScores first{"first", "own frame", "", quality.scores(), 4, 0.5};
  NamedPointScores second{"second", "next frame", "", PointQuality().scores(), 0, 0.0};
  const std::string table = point_table({first, second}, {});
  EXPECT_NE(table.find("first"), std::string::npos);
  EXPECT_NE(table.find("next frame"), std::string::npos);
  const auto row = [&table](const std::string& name) {
    const std::size_t at = table.find(name);
    return table.substr(at, table.find('\n', at) - at);
  };
  EXPECT_NE(row("  within 1 % of depth").find("50.0 %"), std::string::npos);
  EXPECT_EQ(row("  within 1 % of depth").back(), '-');
  EXPECT_NE(row("processor ms per image").find("125.0"), std::string::npos);
  EXPECT_NE(row("points per processor second").find(" 4 "), std::string::npos);
  const std::string json = point_json({first, second}, {});
  EXPECT_NE(json.find("\"processor_s_per_image\": 0.125"), std::string::npos);
  EXPECT_NE(json.find("\"median_relative\": null"), std::string::npos);
}

}  // namespace
}  // namespace facet_mapping
