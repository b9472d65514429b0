// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labels/label_image.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {
namespace {

LabelSet cityscapes() {
  return LabelSet::load(std::string(FACET_MAPPING_SOURCE_DIR) + "/config/labels/cityscapes.yaml");
}

/// Blocks of random classes, as segmentations look; ids 0..18.
cv::Mat random_labels(int width, int height, int block) {
  cv::Mat small((height + block - 1) / block, (width + block - 1) / block, CV_16UC1);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> id(0, 18);
  for (auto& label : cv::Mat_<Label>(small)) {
    label = static_cast<Label>(id(random));
  }
  cv::Mat large;
  cv::resize(small, large, {width, height}, 0, 0, cv::INTER_NEAREST);
  return large;
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(DecodeLabelImage, ReadsEveryIdEncoding) {
  const LabelSet labels = cityscapes();
  const cv::Mat ids = random_labels(40, 30, 3);
  for (const auto& [encoding, type] :
       std::vector<std::pair<std::string, int>>{{"mono8", CV_8UC1},
                                                {"8UC1", CV_8UC1},
                                                {"mono16", CV_16UC1},
                                                {"16UC1", CV_16UC1},
                                                {"32SC1", CV_32SC1}}) {
    cv::Mat image;
    ids.convertTo(image, type);
    LabelImageReport report;
    EXPECT_TRUE(equal(decode_label_image(image, encoding, labels, &report), ids)) << encoding;
    EXPECT_TRUE(report.clean()) << report.to_string();
    EXPECT_EQ(report.pixels, ids.total());
  }
}

TEST(DecodeLabelImage, ReadsColorsInBothOrdersAndPartsOfLargerImages) {
  const LabelSet labels = cityscapes();
  const cv::Mat ids = random_labels(60, 45, 4);
  const cv::Mat bgr = color_label_image(ids, labels);
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  LabelImageReport report;
  EXPECT_TRUE(equal(decode_label_image(bgr, "bgr8", labels, &report), ids));
  EXPECT_TRUE(report.clean());
  EXPECT_TRUE(equal(decode_label_image(rgb, "rgb8", labels), ids));
  const cv::Rect part(7, 5, 31, 20);
  EXPECT_TRUE(equal(decode_label_image(bgr(part), "bgr8", labels), ids(part).clone()));
}

TEST(DecodeLabelImage, CountsUnknownIdsAndForgetsIgnoredOnes) {
  const LabelSet labels = cityscapes();
  const cv::Mat ids = (cv::Mat_<std::int32_t>(2, 4) << 0, 18, 255, 19, 19, -1, 70000, 65535);
  LabelImageReport report;
  const cv::Mat decoded = decode_label_image(ids, "32SC1", labels, &report);
  const cv::Mat expected =
      (cv::Mat_<Label>(2, 4) << 0, 18, 65535, 65535, 65535, 65535, 65535, 65535);
  EXPECT_TRUE(equal(decoded, expected));
  EXPECT_EQ(report.unknown_ids, (std::map<int, std::size_t>{{-1, 1}, {19, 2}, {70000, 1}}));
  EXPECT_NE(report.to_string().find("4 of 8 pixels (50 %)"), std::string::npos)
      << report.to_string();
}

TEST(DecodeLabelImage, ReadsAliasesAndForgetsIgnoredColors) {
  const LabelSet labels({{3, "tree", {0, 100, 0}, false, false, false, false, {{0, 200, 0}}},
                         {4, "void", {0, 0, 0}, false, true, false, false, {}}});
  const cv::Mat image = (cv::Mat_<cv::Vec3b>(1, 4) << cv::Vec3b(0, 100, 0),
                         cv::Vec3b(0, 200, 0),
                         cv::Vec3b(0, 0, 0),
                         cv::Vec3b(5, 5, 5));
  LabelImageReport report;
  const cv::Mat decoded = decode_label_image(image, "rgb8", labels, &report);
  EXPECT_TRUE(equal(decoded, (cv::Mat_<Label>(1, 4) << 3, 3, kUnlabelled, kUnlabelled)));
  EXPECT_EQ(report.unknown_color_pixels, 1U);
  EXPECT_FALSE(report.looks_lossy || report.looks_swapped);
}

TEST(DecodeLabelImage, NoticesSwappedChannels) {
  const LabelSet labels = cityscapes();
  const cv::Mat bgr = color_label_image(random_labels(200, 100, 8), labels);
  LabelImageReport report;
  decode_label_image(bgr, "rgb8", labels, &report);
  EXPECT_TRUE(report.looks_swapped);
  EXPECT_NE(report.to_string().find("red and blue look swapped"), std::string::npos);
}

TEST(DecodeLabelImage, NoticesLossyCompression) {
  const LabelSet labels = cityscapes();
  const cv::Mat bgr = color_label_image(random_labels(400, 300, 10), labels);
  std::vector<std::uint8_t> jpeg;
  ASSERT_TRUE(cv::imencode(".jpg", bgr, jpeg));
  LabelImageReport report;
  decode_label_image(cv::imdecode(jpeg, cv::IMREAD_COLOR), "bgr8", labels, &report);
  EXPECT_TRUE(report.looks_lossy);
  EXPECT_NE(report.to_string().find("looks lossy-compressed"), std::string::npos);
}

TEST(DecodeLabelImage, TakesAnotherPaletteForNeither) {
  const LabelSet labels = cityscapes();
  const cv::Mat image(20, 20, CV_8UC3, cv::Scalar(1, 2, 3));
  LabelImageReport report;
  decode_label_image(image, "bgr8", labels, &report);
  EXPECT_EQ(report.unknown_color_pixels, 400U);
  EXPECT_FALSE(report.looks_lossy || report.looks_swapped);
}

TEST(DecodeLabelImage, RefusesWhatItCannotRead) {
  const LabelSet labels = cityscapes();
  const cv::Mat grey(4, 4, CV_8UC1, cv::Scalar(0));
  EXPECT_THROW(decode_label_image(grey, "mono16", labels), std::invalid_argument);
  EXPECT_THROW(decode_label_image(grey, "rgb8", labels), std::invalid_argument);
  EXPECT_THROW(decode_label_image(grey, "32FC1", labels), std::invalid_argument);
  EXPECT_THROW(decode_label_image(grey, "", labels), std::invalid_argument);
  EXPECT_THROW(decode_label_image(cv::Mat(), "mono8", labels), std::invalid_argument);
  EXPECT_THROW(decode_label_image(grey, "mono8", LabelSet()), std::invalid_argument);
}

/// The id of each target pixel must be that of the source pixel whose area holds the target pixel's
/// centre, where the cameras of both sizes see the same ray.
void expect_follows_camera(const cv::Size& from, const cv::Size& to) {
  cv::Mat labels(from, CV_16UC1);
  for (int i = 0; i < static_cast<int>(labels.total()); ++i) {
    labels.at<Label>(i / from.width, i % from.width) = static_cast<Label>(i);
  }
  const PinholeCamera camera{from.width, from.height, 500.0, 510.0, 20.3, 10.7};
  const PinholeCamera resized_camera = camera.resized(to.width, to.height);
  const cv::Mat resized = resize_label_image(labels, to);
  ASSERT_EQ(resized.size(), to);
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const int id = resized.at<Label>(y, x);
      const int source_y = id / from.width;
      const Eigen::Vector2d pixel = camera.project(resized_camera.ray({x, y}));
      EXPECT_LE(std::abs(pixel.x() - id % from.width), 0.5 + 1e-9);
      EXPECT_LE(std::abs(pixel.y() - source_y), 0.5 + 1e-9);
    }
  }
}

TEST(ResizeLabelImage, KeepsPixelAreas) {
  expect_follows_camera({41, 23}, {41, 23});
  expect_follows_camera({41, 23}, {82, 46});
  expect_follows_camera({41, 23}, {97, 31});
  expect_follows_camera({41, 23}, {17, 11});
  expect_follows_camera({40, 20}, {10, 5});
  expect_follows_camera({41, 23}, {1, 1});
}

TEST(ResizeLabelImage, RefusesBadInput) {
  const cv::Mat labels(4, 4, CV_16UC1, cv::Scalar(0));
  EXPECT_THROW(resize_label_image(labels, {0, 4}), std::invalid_argument);
  EXPECT_THROW(resize_label_image(cv::Mat(4, 4, CV_8UC1), {2, 2}), std::invalid_argument);
  EXPECT_THROW(resize_label_image(cv::Mat(), {2, 2}), std::invalid_argument);
}

TEST(ColorLabelImage, PaintsUnknownIdsGrey) {
  const LabelSet labels = cityscapes();
  const cv::Mat ids = (cv::Mat_<Label>(1, 3) << 13, 500, kUnlabelled);
  const cv::Mat picture = color_label_image(ids, labels);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 0), cv::Vec3b(142, 0, 0));
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 1), cv::Vec3b(128, 128, 128));
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 2), cv::Vec3b(128, 128, 128));
  EXPECT_THROW(color_label_image(cv::Mat(2, 2, CV_8UC1), labels), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
