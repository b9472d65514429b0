// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/segmentation_noise.h"

#include <stdexcept>

#include "synthetic/test_street.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/synthetic/street_view.h"

namespace facet_mapping {
namespace {

const cv::Mat& exact_labels() {
  static const cv::Mat kLabels = [] {
    StreetViewConfig config;
    config.supersampling = 1;
    config.shadows = false;
    const StreetRenderer renderer(testing::short_street(), config);
    const Eigen::Isometry3d& pose = testing::short_street().trajectory[3].map_from_left;
    return renderer.render(kitti_rig(false).left_view(pose), {}).labels;
  }();
  return kLabels;
}

double error(const cv::Mat& labels) {
  return static_cast<double>(cv::countNonZero(labels != exact_labels())) /
         static_cast<double>(labels.total());
}

TEST(SegmentationNoise, LevelZeroIsExact) {
  EXPECT_EQ(error(noisy_segmentation(exact_labels(), 0.0, 1)), 0.0);
}

TEST(SegmentationNoise, ErrorGrowsWithTheLevel) {
  for (const std::uint64_t seed : {1U, 2U}) {
    double before = 0.0;
    for (const double level : {0.2, 0.4, 0.7, 1.0, 1.4, 2.0}) {
      const double now = error(noisy_segmentation(exact_labels(), level, seed));
      EXPECT_GT(now, before) << "level " << level << ", seed " << seed;
      before = now;
    }
  }
}

TEST(SegmentationNoise, LevelOneIsAboutAsWrongAsASmallNetwork) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    sum += error(noisy_segmentation(exact_labels(), 1.0, seed));
  }
  EXPECT_GT(sum / 4, 0.08);
  EXPECT_LT(sum / 4, 0.25);
}

TEST(SegmentationNoise, SeedsAreIndependentAndRepeat) {
  const cv::Mat a = noisy_segmentation(exact_labels(), 1.0, 1);
  const cv::Mat b = noisy_segmentation(exact_labels(), 1.0, 2);
  EXPECT_EQ(cv::countNonZero(a != noisy_segmentation(exact_labels(), 1.0, 1)), 0);
  // Were the errors the same, a and b would agree where both are wrong.
  const cv::Mat a_wrong = a != exact_labels();
  const cv::Mat b_wrong = b != exact_labels();
  const double both = cv::countNonZero(a_wrong & b_wrong);
  EXPECT_LT(both, 0.6 * cv::countNonZero(a_wrong));
}

TEST(SegmentationNoise, KeepsVoidAndInventsNoClass) {
  cv::Mat labels = exact_labels().clone();
  labels(cv::Rect(100, 50, 40, 30)).setTo(255);
  const cv::Mat noisy = noisy_segmentation(labels, 1.5, 1);
  EXPECT_EQ(cv::countNonZero((noisy == 255) != (labels == 255)), 0);
  for (int id = 0; id < 255; ++id) {
    const bool street = id <= 2 || id == 5 || (id >= 7 && id <= 10) || id == 13;
    EXPECT_TRUE(street || cv::countNonZero(noisy == id) == 0) << id;
  }
}

TEST(SegmentationNoise, RefusesNonsense) {
  EXPECT_THROW(noisy_segmentation({}, 1.0, 1), std::invalid_argument);
  EXPECT_THROW(noisy_segmentation(exact_labels(), -1.0, 1), std::invalid_argument);
  EXPECT_THROW(noisy_segmentation(cv::Mat(4, 4, CV_16UC1), 1.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
