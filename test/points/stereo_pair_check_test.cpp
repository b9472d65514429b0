// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/stereo_pair_check.h"

#include <stdexcept>

#include "stereo_scenes.h"
#include "support/shared_data.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace facet_mapping {
namespace {

using test::make_pair;
using test::make_texture;

/// Moved down by `pixels`.
cv::Mat moved_down(const cv::Mat& image, double pixels) {
  cv::Mat moved;
  const cv::Matx23d shift(1.0, 0.0, 0.0, 0.0, 1.0, pixels);
  cv::warpAffine(image, moved, shift, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  return moved;
}

cv::Mat brightened(const cv::Mat& image, double factor) {
  cv::Mat bright;
  image.convertTo(bright, -1, factor);
  return bright;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(StereoPairCheck, HasNothingAgainstAGoodPair) {
  const auto [left, right] = make_pair(640, 240, 1, {30.0, -0.02, 0.05});
  const StereoPairReport report = check_stereo_pair(left, right);
  EXPECT_EQ(report.problem, StereoPairProblem::kNone) << report.sentence;
  EXPECT_TRUE(report.sentence.empty());
  EXPECT_GT(report.matched, report.corners / 2);
  EXPECT_EQ(report.swapped_share, 0.0);
  EXPECT_LT(report.row_error_px, 0.2);
}

TEST(StereoPairCheck, HasNothingAgainstAFarScene) {
  const auto [left, right] = make_pair(640, 240, 2, {0.3, 0.0, 0.0});
  EXPECT_EQ(check_stereo_pair(left, right).problem, StereoPairProblem::kNone);
  EXPECT_EQ(check_stereo_pair(right, left).problem, StereoPairProblem::kNone);
}

TEST(StereoPairCheck, FindsSwappedImages) {
  const auto [left, right] = make_pair(640, 240, 3, {30.0, 0.0, 0.05});
  const StereoPairReport report = check_stereo_pair(right, left);
  EXPECT_EQ(report.problem, StereoPairProblem::kSwapped);
  EXPECT_TRUE(contains(report.sentence, "swapped")) << report.sentence;
  EXPECT_TRUE(contains(report.sentence, "exchange")) << report.sentence;
}

TEST(StereoPairCheck, MeasuresTheRowErrorOfUnrectifiedImages) {
  const auto [left, right] = make_pair(640, 240, 4, {30.0, 0.0, 0.0});
  const StereoPairReport report = check_stereo_pair(left, moved_down(right, 3.5));
  EXPECT_EQ(report.problem, StereoPairProblem::kRowsDiffer);
  EXPECT_NEAR(report.row_error_px, 3.5, 0.2);
  EXPECT_TRUE(contains(report.sentence, "rectified")) << report.sentence;
  EXPECT_EQ(check_stereo_pair(left, moved_down(right, 0.5)).problem, StereoPairProblem::kNone);
}

TEST(StereoPairCheck, FindsTheSameAtHalfSize) {
  const auto [left, right] = make_pair(1000, 240, 5, {30.0, 0.0, 0.0});
  EXPECT_EQ(check_stereo_pair(left, right).problem, StereoPairProblem::kNone);
  EXPECT_EQ(check_stereo_pair(right, left).problem, StereoPairProblem::kSwapped);
  EXPECT_NEAR(check_stereo_pair(left, moved_down(right, 4.0)).row_error_px, 4.0, 0.4);
}

TEST(StereoPairCheck, FindsUnrelatedImages) {
  const StereoPairReport report =
      check_stereo_pair(make_texture(640, 240, 6), make_texture(640, 240, 7));
  EXPECT_EQ(report.problem, StereoPairProblem::kNoMatch);
  EXPECT_TRUE(contains(report.sentence, "same moment")) << report.sentence;
}

TEST(StereoPairCheck, FindsAJumpOfTheExposure) {
  const auto [left, right] = make_pair(640, 240, 8, {30.0, 0.0, 0.0});
  const StereoPairReport report = check_stereo_pair(left, brightened(right, 0.4));
  EXPECT_EQ(report.problem, StereoPairProblem::kExposure);
  EXPECT_NEAR(report.brightness_ratio, 0.4, 0.05);
  EXPECT_EQ(check_stereo_pair(left, brightened(right, 0.8)).problem, StereoPairProblem::kNone);
}

TEST(StereoPairCheck, FindsBlankImages) {
  const cv::Mat texture = make_texture(320, 120, 9);
  const cv::Mat blank(texture.size(), CV_8UC1, cv::Scalar(17));
  const StereoPairReport left = check_stereo_pair(blank, texture);
  EXPECT_EQ(left.problem, StereoPairProblem::kBlank);
  EXPECT_TRUE(contains(left.sentence, "left")) << left.sentence;
  const StereoPairReport right = check_stereo_pair(texture, blank);
  EXPECT_EQ(right.problem, StereoPairProblem::kBlank);
  EXPECT_TRUE(contains(right.sentence, "right")) << right.sentence;
  EXPECT_EQ(check_stereo_pair({}, {}).problem, StereoPairProblem::kBlank);
}

TEST(StereoPairCheck, TakesImagesOfAnySizeAndRefusesWhatIsNoPair) {
  for (const int size : {1, 5, 12, 15, 40}) {
    const cv::Mat image = make_texture(size, size, 10);
    EXPECT_NO_THROW(check_stereo_pair(image, image)) << size;
  }
  const cv::Mat image = make_texture(40, 40, 11);
  EXPECT_THROW(check_stereo_pair(image, image.colRange(0, 30)), std::invalid_argument);
  const cv::Mat color(40, 40, CV_8UC3, cv::Scalar(0));
  EXPECT_THROW(check_stereo_pair(color, color), std::invalid_argument);
}

TEST(StereoPairCheck, JudgesARealStreet) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const auto read = [&](const std::string& file) {
    return cv::imread(folder + file, cv::IMREAD_GRAYSCALE);
  };
  for (const char* name : {"/000003.png", "/000024.png", "/000047.png"}) {
    const cv::Mat left = read(std::string("/left") + name);
    const cv::Mat right = read(std::string("/right") + name);
    const StereoPairReport good = check_stereo_pair(left, right);
    EXPECT_EQ(good.problem, StereoPairProblem::kNone) << name << ": " << good.sentence;
    EXPECT_EQ(check_stereo_pair(right, left).problem, StereoPairProblem::kSwapped) << name;
    EXPECT_EQ(check_stereo_pair(left, moved_down(right, 4.0)).problem,
              StereoPairProblem::kRowsDiffer)
        << name;
    EXPECT_EQ(check_stereo_pair(left, brightened(right, 0.5)).problem, StereoPairProblem::kExposure)
        << name;
  }
  // A camera that is one frame (1.1 m) behind the other.
  const StereoPairReport late =
      check_stereo_pair(read("/left/000025.png"), read("/right/000024.png"));
  EXPECT_TRUE(late.problem == StereoPairProblem::kRowsDiffer ||
              late.problem == StereoPairProblem::kNoMatch)
      << late.sentence;
}

}  // namespace
}  // namespace facet_mapping
