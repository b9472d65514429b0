// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stereo against LiDAR depth on a real street.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/points/stereo_points.h"

namespace facet_mapping {
namespace {

// kitti_drive_0009/calib.txt
constexpr double kFocal = 721.5377;    // pixels
constexpr double kBaseline = 0.54325;  // metres
constexpr double kDepthPerUnit = 1.0 / 256.0;

struct Frame {
  cv::Mat left;
  cv::Mat right;
  cv::Mat labels;
  cv::Mat true_disparity;  // pixels, 0 = none
};

Frame read_frame(const std::string& folder, const std::string& name) {
  const std::string file = "/" + name + ".png";
  Frame frame;
  frame.left = cv::imread(folder + "/left" + file, cv::IMREAD_GRAYSCALE);
  frame.right = cv::imread(folder + "/right" + file, cv::IMREAD_GRAYSCALE);
  const LabelSet classes =
      LabelSet::load(std::string(FACET_MAPPING_SOURCE_DIR) + "/config/labels/cityscapes.yaml");
  frame.labels = decode_label_image(
      cv::imread(folder + "/labels" + file, cv::IMREAD_UNCHANGED), "mono8", classes);
  const cv::Mat depth = cv::imread(folder + "/gt_depth" + file, cv::IMREAD_UNCHANGED);
  frame.true_disparity = cv::Mat::zeros(depth.size(), CV_64F);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double metres = depth.at<std::uint16_t>(y, x) * kDepthPerUnit;
      frame.true_disparity.at<double>(y, x) = metres > 0.0 ? kFocal * kBaseline / metres : 0.0;
    }
  }
  return frame;
}

/// Errors of disparities against the truth.
struct Errors {
  std::vector<double> absolute;  // pixels
  std::size_t outliers = 0;      // off by more than 3 px and 5 %
  std::size_t within_sigmas[3] = {0, 0, 0};

  void add(double disparity, double truth) {
    if (truth > 0.0 && disparity > 0.0) {
      const double error = std::abs(disparity - truth);
      absolute.push_back(error);
      outliers += error > 3.0 && error > 0.05 * truth ? 1 : 0;
    }
  }

  void add_sigma(double error_in_sigmas) {
    for (int k = 0; k < 3; ++k) {
      within_sigmas[k] += error_in_sigmas < k + 1 ? 1 : 0;
    }
  }

  double share_within(int sigmas) const {
    return static_cast<double>(within_sigmas[sigmas - 1]) / static_cast<double>(absolute.size());
  }

  double median() {
    std::nth_element(absolute.begin(), absolute.begin() + absolute.size() / 2, absolute.end());
    return absolute[absolute.size() / 2];
  }

  double outlier_share() const {
    return static_cast<double>(outliers) / static_cast<double>(absolute.size());
  }
};

TEST(RealStereo, DisparitiesAgreeWithLidar) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  Errors errors;
  std::size_t truths = 0;
  for (const char* name : {"000003", "000024", "000047"}) {
    const Frame frame = read_frame(folder, name);
    const cv::Mat disparity = stereo_disparity(frame.left, frame.right, {});
    truths += cv::countNonZero(frame.true_disparity);
    for (int y = 0; y < disparity.rows; ++y) {
      for (int x = 0; x < disparity.cols; ++x) {
        errors.add(disparity.at<float>(y, x), frame.true_disparity.at<double>(y, x));
      }
    }
  }
  EXPECT_GT(errors.absolute.size(), 0.75 * static_cast<double>(truths));
  EXPECT_LT(errors.median(), 0.4);
  EXPECT_LT(errors.outlier_share(), 0.05);
}

TEST(RealStereo, PointsAgreeWithLidarAndAreManyButNoneInTheSky) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Label sky = 10;
  StereoConfig config;
  config.excluded_labels = {sky};
  Errors errors;
  for (const char* name : {"000003", "000024", "000047"}) {
    const Frame frame = read_frame(folder, name);
    const PinholeCamera camera{frame.left.cols, frame.left.rows, kFocal, kFocal, 609.5593, 172.854};
    const std::vector<LabeledPoint> points =
        stereo_points(frame.left, frame.right, frame.labels, camera, kBaseline, config);
    EXPECT_GT(points.size(), 5000U) << name;
    EXPECT_LT(points.size(), 13000U) << name;
    for (const LabeledPoint& point : points) {
      const Eigen::Vector2d pixel = camera.project(point.position.cast<double>());
      EXPECT_NE(point.label, sky);
      const double truth = frame.true_disparity.at<double>(
          static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
      errors.add(kFocal * kBaseline / point.position.z(), truth);
      if (truth > 0.0) {
        errors.add_sigma(std::abs(point.position.z() - kFocal * kBaseline / truth) / point.sigma);
      }
    }
  }
  ASSERT_GT(errors.absolute.size(), 500U);
  EXPECT_LT(errors.median(), 0.4);
  EXPECT_LT(errors.outlier_share(), 0.03);
  // A normal distribution's are 68, 95 and 99.7 %.
  EXPECT_NEAR(errors.share_within(1), 0.68, 0.1);
  EXPECT_GT(errors.share_within(2), 0.9);
  EXPECT_GT(errors.share_within(3), 0.94);
}

}  // namespace
}  // namespace facet_mapping
