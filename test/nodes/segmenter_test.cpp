// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Images in, class images with their headers out; a slow model drops the oldest.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "../support/onnx_file.h"
#include "node_harness.h"
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>

#include "facet_mapping/ros/segmenter_node.h"

namespace facet_mapping::test {
namespace {

/// The node under test as /diagnostics calls it; rostest names the program.
std::string node_name() {
  return ros::this_node::getName().substr(1) + "/segmenter";
}

/// Listens to a topic.
struct Ear {
  explicit Ear(const std::string& topic)
      : subscriber(ros::NodeHandle().subscribe<sensor_msgs::Image>(
            topic, 1000, [this](const sensor_msgs::ImageConstPtr& m) { images.push_back(m); })) {}
  std::vector<sensor_msgs::ImageConstPtr> images;
  ros::Subscriber subscriber;
};

/// Three classes, one per colour channel, for inputs of this size.
std::string write_network(int width, int height) {
  std::string path = std::string(::testing::TempDir()) + "segmenter_test.onnx";
  facet_mapping::testing::write_bytes(
      path,
      facet_mapping::testing::onnx_classifier(
          {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, width, height));
  return path;
}

std::string write_text(const std::string& name, const std::string& text) {
  std::string path = std::string(::testing::TempDir()) + name;
  facet_mapping::testing::write_bytes(path, text);
  return path;
}

sensor_msgs::Image picture(const cv::Mat& bgr, double stamp_s) {
  std_msgs::Header header;
  header.stamp = ros::Time(stamp_s);
  header.frame_id = "some_camera";
  return *cv_bridge::CvImage(header, "bgr8", bgr).toImageMsg();
}

class SegmenterNodeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    camera_ = ros::NodeHandle().advertise<sensor_msgs::Image>("image_rect", 1000);
    set("diagnostic_period", 0.1);
    set("label_file",
        write_text("segmenter_test.yaml",
                   "classes:\n"
                   "  - {id: 4, name: red, color: [255, 0, 0]}\n"
                   "  - {id: 7, name: green, color: [0, 255, 0]}\n"
                   "  - {id: 9, name: blue, color: [0, 0, 255]}\n"));
    set("min_confidence", 0.0);
    set("max_rate_hz", 0.0);
  }

  template <typename T>
  static void set(const std::string& name, const T& value) {
    ros::param::set("~segmenter/" + name, value);
  }

  void start(int width, int height) {
    set("model", write_network(width, height));
    set("network/input_width", width);
    set("network/input_height", height);
    node_ = std::make_unique<SegmenterNode>(ros::NodeHandle(), ros::NodeHandle("~segmenter"));
    ASSERT_TRUE(wait_until([&] {
      return camera_.getNumSubscribers() > 0 && labels_.subscriber.getNumPublishers() > 0 &&
             confidence_.subscriber.getNumPublishers() > 0;
    }));
    wait_until([] { return false; }, 0.3);  // the node must know of the ears, too
  }

  ros::Publisher camera_;
  Ear labels_{"segmentation"};
  Ear confidence_{"segmentation_confidence"};
  DiagnosticsEar diagnostics_;
  std::unique_ptr<SegmenterNode> node_;
};

TEST_F(SegmenterNodeTest, ClassImageHasTheImagesHeader) {
  set("queue_size", 2);
  start(8, 8);
  cv::Mat bgr(20, 30, CV_8UC3, cv::Scalar(0, 0, 255));
  bgr.colRange(15, 30).setTo(cv::Scalar(255, 0, 0));
  const sensor_msgs::Image image = picture(bgr, 123.456);
  camera_.publish(image);
  ASSERT_TRUE(wait_until([&] { return !labels_.images.empty() && !confidence_.images.empty(); }));
  const sensor_msgs::Image& labels = *labels_.images.front();
  EXPECT_EQ(labels.header.stamp, image.header.stamp);
  EXPECT_EQ(labels.header.frame_id, image.header.frame_id);
  ASSERT_EQ(labels.encoding, "mono8");
  ASSERT_EQ(labels.width, 30U);
  ASSERT_EQ(labels.height, 20U);
  EXPECT_EQ(labels.data[5 * labels.step + 2], 4);
  EXPECT_EQ(labels.data[5 * labels.step + 27], 9);
  EXPECT_EQ(confidence_.images.front()->header.stamp, image.header.stamp);
  EXPECT_GT(confidence_.images.front()->data[2], 200);
}

TEST_F(SegmenterNodeTest, SlowModelDropsTheOldestAndCountsThem) {
  constexpr int kImages = 15;  // fewer than a subscriber's queue holds
  set("queue_size", 1);
  start(1024, 1024);
  const cv::Mat bgr(480, 640, CV_8UC3, cv::Scalar(0, 255, 0));
  for (int k = 1; k <= kImages; ++k) {
    camera_.publish(picture(bgr, k));
  }
  const auto dropped = [&] {
    return diagnostics_.value(node_name(), "problem: segmenter too slow");
  };
  ASSERT_TRUE(wait_until([&] { return labels_.images.size() + dropped() == kImages; }))
      << labels_.images.size() << " + " << dropped();
  EXPECT_GT(dropped(), 0U);
  EXPECT_EQ(labels_.images.back()->header.stamp, ros::Time(kImages));
  for (std::size_t k = 1; k < labels_.images.size(); ++k) {
    EXPECT_LT(labels_.images[k - 1]->header.stamp, labels_.images[k]->header.stamp);
  }
}

TEST_F(SegmenterNodeTest, RateIsLimitedByTheStamps) {
  set("queue_size", 100);
  set("max_rate_hz", 1.0);
  start(8, 8);
  const cv::Mat bgr(20, 30, CV_8UC3, cv::Scalar(0, 255, 0));
  for (int k = 0; k < 17; ++k) {
    camera_.publish(picture(bgr, 100.0 + 0.25 * k));
  }
  ASSERT_TRUE(wait_until([&] {
    return diagnostics_.value(node_name(), "images skipped by max_rate_hz") == 12 &&
           labels_.images.size() == 5;
  })) << labels_.images.size();
}

TEST_F(SegmenterNodeTest, BadImagesAreCountedAndTheNodeLivesOn) {
  set("queue_size", 10);
  start(8, 8);
  const cv::Mat bgr(20, 30, CV_8UC3, cv::Scalar(0, 255, 0));
  EXPECT_TRUE(diagnostics_.rises(
      node_name(), "problem: no stamp", [&] { camera_.publish(picture(bgr, 0.0)); }));
  sensor_msgs::Image truncated = picture(bgr, 1.0);
  truncated.data.resize(50);
  EXPECT_TRUE(diagnostics_.rises(
      node_name(), "problem: unusable image", [&] { camera_.publish(truncated); }));
  camera_.publish(picture(bgr, 2.0));
  EXPECT_TRUE(wait_until([&] { return !labels_.images.empty(); }));
}

TEST_F(SegmenterNodeTest, ModelsThatCannotBeUsedAreToldAtTheStart) {
  set("model", std::string("/no/such/file.onnx"));
  EXPECT_THROW(SegmenterNode(ros::NodeHandle(), ros::NodeHandle("~segmenter")), std::runtime_error);
  set("model", std::string());
  EXPECT_THROW(SegmenterNode(ros::NodeHandle(), ros::NodeHandle("~segmenter")), ConfigError);
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "segmenter_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
