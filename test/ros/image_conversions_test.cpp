// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/image_conversions.h"

#include <limits>
#include <stdexcept>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace facet_mapping {
namespace {

const cv::Size kSize(64, 48);

sensor_msgs::CameraInfo rectified_info() {
  sensor_msgs::CameraInfo info;
  info.width = kSize.width;
  info.height = kSize.height;
  info.K = {50, 0, 31, 0, 50, 23, 0, 0, 1};
  info.P = {48, 0, 30, 0, 0, 49, 22, 0, 0, 0, 1, 0};
  return info;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

std::string camera_problem(const sensor_msgs::CameraInfo& info,
                           const std::string& topic = "/cam/image_rect") {
  return message_of([&] { camera_from_info(info, kSize, topic); });
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CameraInfo, ProjectionOfTheRectifiedImageIsUsed) {
  const PinholeCamera camera = camera_from_info(rectified_info(), kSize, "t");
  EXPECT_EQ(camera.fx, 48);
  EXPECT_EQ(camera.fy, 49);
  EXPECT_EQ(camera.cx, 30);
  EXPECT_EQ(camera.cy, 22);
  EXPECT_EQ(camera.width, 64);
}

TEST(CameraInfo, WithoutProjectionTheCameraMatrixServes) {
  sensor_msgs::CameraInfo info = rectified_info();
  info.P.fill(0.0);
  EXPECT_EQ(camera_from_info(info, kSize, "t").fx, 50);
}

TEST(CameraInfo, MissingIntrinsicsAreRefused) {
  sensor_msgs::CameraInfo info = rectified_info();
  info.P.fill(0.0);
  info.K.fill(0.0);
  EXPECT_TRUE(contains(camera_problem(info), "no usable intrinsics"));
  info.P[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(camera_problem(info), "no usable intrinsics"));
}

TEST(CameraInfo, UnrectifiedImageIsRefused) {
  sensor_msgs::CameraInfo info = rectified_info();
  info.D = {-0.3, 0.1, 0.0, 0.0, 0.0};
  EXPECT_EQ(camera_problem(info), "");  // a rectifying node publishes D with P
  EXPECT_TRUE(contains(camera_problem(info, "/cam/image_raw"), "unrectified"));
  info.P = {50, 0, 31, 0, 0, 50, 23, 0, 0, 0, 1, 0};
  EXPECT_TRUE(contains(camera_problem(info), "unrectified"));
}

TEST(CameraInfo, AnotherSizeIsRefused) {
  sensor_msgs::CameraInfo info = rectified_info();
  info.width = 640;
  EXPECT_TRUE(contains(camera_problem(info), "640x48"));
}

TEST(Baseline, FollowsFromTheProjections) {
  sensor_msgs::CameraInfo left = rectified_info();
  sensor_msgs::CameraInfo right = rectified_info();
  right.P[3] = -48 * 0.5;
  EXPECT_DOUBLE_EQ(baseline_from_info(left, right), 0.5);
  // KITTI's colour cameras are both offset against the first grey one.
  left.P[3] = 48 * 0.06;
  right.P[3] = -48 * 0.44;
  EXPECT_NEAR(baseline_from_info(left, right), 0.5, 1e-12);
}

TEST(Baseline, SwappedOrMissingIsRefused) {
  const sensor_msgs::CameraInfo left = rectified_info();
  sensor_msgs::CameraInfo right = rectified_info();
  EXPECT_TRUE(contains(message_of([&] { baseline_from_info(left, right); }), "no baseline"));
  right.P[3] = 48 * 0.5;
  EXPECT_TRUE(contains(message_of([&] { baseline_from_info(left, right); }), "swap"));
}

sensor_msgs::Image image_message(const cv::Mat& pixels, const std::string& encoding) {
  return *cv_bridge::CvImage(std_msgs::Header(), encoding, pixels).toImageMsg();
}

TEST(GrayImage, UsualEncodingsAreConverted) {
  const cv::Mat gray(kSize, CV_8UC1, cv::Scalar(100));
  const cv::Mat color(kSize, CV_8UC3, cv::Scalar(100, 100, 100));
  for (const char* encoding : {"mono8", "8UC1"}) {
    EXPECT_EQ(gray_from_message(image_message(gray, encoding), "t").at<uchar>(5, 5), 100);
  }
  for (const char* encoding : {"rgb8", "bgr8"}) {
    EXPECT_NEAR(gray_from_message(image_message(color, encoding), "t").at<uchar>(5, 5), 100, 1);
  }
  EXPECT_EQ(gray_from_message(image_message(gray, "bayer_rggb8"), "t").type(), CV_8UC1);
}

TEST(GrayImage, WrongOrMissingEncodingIsRefused) {
  const cv::Mat depth(kSize, CV_32FC1, cv::Scalar(1.0));
  sensor_msgs::Image image = image_message(depth, "32FC1");
  EXPECT_TRUE(
      contains(message_of([&] { gray_from_message(image, "/cam/depth"); }), "'32FC1' is not"));
  image.encoding = "";
  EXPECT_TRUE(contains(message_of([&] { gray_from_message(image, "/cam"); }), "mono8"));
  image.encoding = "nonsense";
  EXPECT_TRUE(contains(message_of([&] { gray_from_message(image, "/cam"); }), "mono8"));
}

TEST(GrayImage, TruncatedDataIsRefused) {
  sensor_msgs::Image image = image_message(cv::Mat(kSize, CV_8UC1), "mono8");
  image.data.resize(100);
  EXPECT_TRUE(contains(message_of([&] { gray_from_message(image, "/cam"); }), "truncated"));
  image.width = 0;
  EXPECT_TRUE(contains(message_of([&] { gray_from_message(image, "/cam"); }), "empty"));
}

LabelSet two_classes() {
  return LabelSet({{0, "road", {128, 64, 128}}, {1, "wall", {70, 70, 70}}});
}

TEST(Labels, IdsAndUnknownIds) {
  cv::Mat ids(kSize, CV_8UC1, cv::Scalar(1));
  ids.at<uchar>(0, 0) = 42;
  LabelImageReport report;
  const cv::Mat labels =
      labels_from_message(image_message(ids, "mono8"), two_classes(), "t", &report);
  EXPECT_EQ(labels.at<std::uint16_t>(5, 5), 1);
  EXPECT_EQ(labels.at<std::uint16_t>(0, 0), kUnlabelled);
  EXPECT_EQ(report.unknown_ids.count(42), 1U);
}

TEST(Labels, WrongOrMissingEncodingIsRefused) {
  sensor_msgs::Image image = image_message(cv::Mat(kSize, CV_32FC1, cv::Scalar(1.0)), "32FC1");
  EXPECT_NE(message_of([&] { labels_from_message(image, two_classes(), "t", nullptr); }), "");
  image.encoding = "";
  EXPECT_TRUE(contains(message_of([&] { labels_from_message(image, two_classes(), "t", nullptr); }),
                       "no encoding"));
}

sensor_msgs::CompressedImage compressed(const cv::Mat& pixels, const std::string& extension) {
  sensor_msgs::CompressedImage message;
  message.format = extension;
  cv::imencode("." + extension, pixels, message.data);
  return message;
}

TEST(Labels, PngIsReadAndLossyFormatsAreRefused) {
  const cv::Mat ids(kSize, CV_8UC1, cv::Scalar(1));
  EXPECT_EQ(labels_from_message(compressed(ids, "png"), two_classes(), "t", nullptr)
                .at<std::uint16_t>(3, 3),
            1);
  EXPECT_TRUE(contains(
      message_of([&] { labels_from_message(compressed(ids, "jpg"), two_classes(), "t", nullptr); }),
      "lossy"));
  sensor_msgs::CompressedImage truncated = compressed(ids, "png");
  truncated.data.resize(20);
  EXPECT_TRUE(contains(
      message_of([&] { labels_from_message(truncated, two_classes(), "t", nullptr); }), "damaged"));
}

sensor_msgs::Image confidence_message(const std::string& encoding, const cv::Mat& values) {
  return *cv_bridge::CvImage({}, encoding, values).toImageMsg();
}

TEST(Confidence, EveryEncodingHasItsCertainty) {
  const cv::Mat narrow = (cv::Mat_<std::uint8_t>(1, 2) << 255, 51);
  const cv::Mat wide = (cv::Mat_<std::uint16_t>(1, 2) << 65535, 13107);
  const cv::Mat real = (cv::Mat_<float>(1, 2) << 1.0F, 0.2F);
  for (const auto& message : {confidence_message("mono8", narrow),
                              confidence_message("mono16", wide),
                              confidence_message("32FC1", real)}) {
    const cv::Mat confidence = confidence_from_message(message, "t");
    EXPECT_FLOAT_EQ(confidence.at<float>(0), 1.0F) << message.encoding;
    EXPECT_FLOAT_EQ(confidence.at<float>(1), 0.2F) << message.encoding;
  }
  EXPECT_NE(message_of([&] {
              confidence_from_message(confidence_message("rgb8", cv::Mat(1, 2, CV_8UC3)), "t");
            }),
            "");
}

TEST(Confidence, UnsurePixelsAreHidden) {
  cv::Mat labels = (cv::Mat_<Label>(2, 2) << 1, 2, 3, 4);
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  hide_unsure_pixels((cv::Mat_<float>(2, 2) << 0.5F, 0.49F, not_a_number, 1.0F), 0.5, &labels);
  EXPECT_EQ(labels.at<Label>(0, 0), 1);
  EXPECT_EQ(labels.at<Label>(0, 1), kUnlabelled);
  EXPECT_EQ(labels.at<Label>(1, 0), kUnlabelled);
  EXPECT_EQ(labels.at<Label>(1, 1), 4);

  cv::Mat large(4, 4, CV_16UC1, cv::Scalar(7));
  hide_unsure_pixels((cv::Mat_<float>(1, 2) << 0.0F, 1.0F), 0.5, &large);
  EXPECT_EQ(large.at<Label>(3, 1), kUnlabelled);
  EXPECT_EQ(large.at<Label>(3, 2), 7);
}

}  // namespace
}  // namespace facet_mapping
