// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/segmentation/network_segmenter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "../support/onnx_file.h"
#include "test_parts.h"

namespace facet_mapping::test {
namespace {

using facet_mapping::testing::onnx_classifier;
using facet_mapping::testing::write_bytes;

constexpr int kWidth = 16;
constexpr int kHeight = 12;

/// Each pixel another colour.
cv::Mat colorful(int width = kWidth, int height = kHeight) {
  cv::Mat image(height, width, CV_8UC3);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

class NetworkSegmenterTest : public FolderTest {
 protected:
  /// The largest of three input channels, as the network sees them.
  NetworkConfig largest_channel(float last_bias = 0.0F) {
    NetworkConfig config;
    config.model = file("net.onnx");
    config.input_width = kWidth;
    config.input_height = kHeight;
    config.mean = {0.0, 0.0, 0.0};
    config.deviation = {255.0, 255.0, 255.0};
    write_bytes(config.model,
                onnx_classifier(
                    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0.0F, 0.0F, last_bias}, kWidth, kHeight));
    return config;
  }
};

/// Checks every pixel against the label and the probability of three scores.
template <typename Scores>
void expect_argmax(NetworkSegmenter* segmenter, const cv::Mat& image, const Scores& scores_of) {
  const std::array<Label, 3> ids{3, 5, 8};
  cv::Mat confidence;
  const cv::Mat labels = segmenter->segment(image, &confidence);
  ASSERT_EQ(labels.type(), CV_16UC1);
  ASSERT_EQ(labels.size(), image.size());
  ASSERT_EQ(confidence.type(), CV_32FC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3b bgr = image.at<cv::Vec3b>(y, x);
      const std::array<double, 3> s = scores_of(bgr[2], bgr[1], bgr[0]);
      const auto best = std::max_element(s.begin(), s.end());
      ASSERT_EQ(labels.at<Label>(y, x), ids[best - s.begin()]) << x << ", " << y;
      const double sum = std::exp(s[0]) + std::exp(s[1]) + std::exp(s[2]);
      ASSERT_NEAR(confidence.at<float>(y, x), std::exp(*best) / sum, 1e-5);
    }
  }
}

TEST_F(NetworkSegmenterTest, EveryPixelIsTheMostLikelyClass) {
  NetworkSegmenter segmenter(largest_channel(0.1F), three_classes());
  expect_argmax(&segmenter, colorful(), [](double r, double g, double b) {
    return std::array<double, 3>{r / 255.0, g / 255.0, b / 255.0 + double(0.1F)};
  });
}

TEST_F(NetworkSegmenterTest, ChannelOrder) {
  NetworkConfig config = largest_channel();
  config.channel_order = ChannelOrder::kBgr;
  NetworkSegmenter segmenter(config, three_classes());
  expect_argmax(&segmenter, colorful(), [](double r, double g, double b) {
    return std::array<double, 3>{b / 255.0, g / 255.0, r / 255.0};
  });
}

TEST_F(NetworkSegmenterTest, MeanAndDeviationBelongToColoursNotToChannels) {
  NetworkConfig config = largest_channel();
  config.mean = {100.0, 50.0, 20.0};
  config.deviation = {40.0, 80.0, 160.0};
  const auto normalised = [](double r, double g, double b) {
    return std::array<double, 3>{(r - 100.0) / 40.0, (g - 50.0) / 80.0, (b - 20.0) / 160.0};
  };
  NetworkSegmenter rgb(config, three_classes());
  expect_argmax(&rgb, colorful(), normalised);
  config.channel_order = ChannelOrder::kBgr;
  NetworkSegmenter bgr(config, three_classes());
  expect_argmax(&bgr, colorful(), [&](double r, double g, double b) {
    const std::array<double, 3> s = normalised(r, g, b);
    return std::array<double, 3>{s[2], s[1], s[0]};
  });
}

TEST_F(NetworkSegmenterTest, ScoresAreInterpolatedToTheImage) {
  // Red on the left, green on the right: the border stays in the middle at four times the size.
  cv::Mat image(4 * kHeight, 4 * kWidth, CV_8UC3, cv::Scalar(0, 0, 255));
  image.colRange(2 * kWidth, 4 * kWidth).setTo(cv::Scalar(0, 255, 0));
  NetworkSegmenter segmenter(largest_channel(), three_classes());
  const cv::Mat labels = segmenter.segment(image);
  EXPECT_EQ(cv::countNonZero(labels.colRange(0, 2 * kWidth) != 3), 0);
  EXPECT_EQ(cv::countNonZero(labels.colRange(2 * kWidth, 4 * kWidth) != 5), 0);
}

TEST_F(NetworkSegmenterTest, UnsurePixelsAreUnlabelled) {
  NetworkConfig config = largest_channel();
  config.min_confidence = 0.45;
  NetworkSegmenter segmenter(config, three_classes());
  cv::Mat confidence;
  const cv::Mat labels = segmenter.segment(colorful(), &confidence);
  const cv::Mat unsure = confidence < config.min_confidence;
  EXPECT_GT(cv::countNonZero(unsure), 0);
  EXPECT_LT(cv::countNonZero(unsure), kWidth * kHeight);
  EXPECT_EQ(cv::countNonZero((labels == kUnlabelled) != unsure), 0);
}

TEST_F(NetworkSegmenterTest, ScalesAreAveraged) {
  NetworkConfig config = largest_channel();
  config.scales = {1.0, 1.0};
  NetworkSegmenter twice(config, three_classes());
  expect_argmax(&twice, colorful(), [](double r, double g, double b) {
    return std::array<double, 3>{r / 255.0, g / 255.0, b / 255.0};
  });
  config.scales = {0.5, 1.0};
  NetworkSegmenter coarse(config, three_classes());
  const cv::Mat plain(kHeight, kWidth, CV_8UC3, cv::Scalar(10, 200, 30));
  EXPECT_EQ(cv::countNonZero(coarse.segment(plain) != 5), 0);
}

TEST_F(NetworkSegmenterTest, ClassMapGivesTheIds) {
  NetworkConfig config = largest_channel();
  config.class_map = file("map.yaml");
  write_bytes(config.class_map, "classes: [8, none, 3]\n");
  NetworkSegmenter segmenter(config, three_classes());
  const auto id_of = [&](const cv::Scalar& bgr) {
    return segmenter.segment(cv::Mat(kHeight, kWidth, CV_8UC3, bgr)).at<Label>(0, 0);
  };
  EXPECT_EQ(id_of({0, 0, 255}), 8);
  EXPECT_EQ(id_of({0, 255, 0}), kUnlabelled);
  EXPECT_EQ(id_of({255, 0, 0}), 3);
  write_bytes(config.class_map, "classes: [8, 77, 3]\n");
  const std::string sentence =
      sentence_of<std::runtime_error>([&] { NetworkSegmenter refused(config, three_classes()); });
  EXPECT_TRUE(contains(sentence, "77") && contains(sentence, config.class_map)) << sentence;
}

TEST_F(NetworkSegmenterTest, NetworkWithAnotherNumberOfClassesIsRefused) {
  const NetworkConfig config = largest_channel();
  write_bytes(config.model, onnx_classifier({{1, 0, 0}, {0, 1, 0}}, {0, 0}, kWidth, kHeight));
  const std::string sentence =
      sentence_of<std::runtime_error>([&] { NetworkSegmenter segmenter(config, three_classes()); });
  EXPECT_TRUE(contains(sentence, "gives 2 classes, but 3 are expected")) << sentence;
  EXPECT_TRUE(contains(sentence, config.model)) << sentence;
}

TEST_F(NetworkSegmenterTest, FilesThatAreNoNetworkAreRefused) {
  NetworkConfig config = largest_channel();
  const std::string whole =
      onnx_classifier({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, kWidth, kHeight);
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, whole.size() / 2}) {
    write_bytes(config.model, whole.substr(0, size));
    const std::string sentence = sentence_of<std::runtime_error>(
        [&] { NetworkSegmenter segmenter(config, three_classes()); });
    EXPECT_TRUE(contains(sentence, config.model)) << size << ": " << sentence;
  }
  config.model = file("missing.onnx");
  EXPECT_TRUE(contains(
      sentence_of<std::runtime_error>([&] { NetworkSegmenter segmenter(config, three_classes()); }),
      "There is no network file"));
}

TEST_F(NetworkSegmenterTest, BadImagesAndSettingsAreRefused) {
  NetworkConfig config = largest_channel();
  NetworkSegmenter segmenter(config, three_classes());
  EXPECT_THROW(segmenter.segment(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(segmenter.segment(cv::Mat(4, 4, CV_8UC1)), std::invalid_argument);
  config.output = "no_such_output";
  EXPECT_TRUE(contains(
      sentence_of<std::runtime_error>([&] { NetworkSegmenter refused(config, three_classes()); }),
      "no_such_output"));
  for (auto change : {+[](NetworkConfig* c) { c->deviation[1] = 0.0; },
                      +[](NetworkConfig* c) { c->input_width = 0; },
                      +[](NetworkConfig* c) { c->scales.clear(); },
                      +[](NetworkConfig* c) { c->min_confidence = 1.5; }}) {
    NetworkConfig bad = largest_channel();
    change(&bad);
    EXPECT_THROW(NetworkSegmenter(bad, three_classes()), std::invalid_argument);
  }
}

}  // namespace
}  // namespace facet_mapping::test
