// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/segmentation/forest_segmenter.h"

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "../support/onnx_file.h"
#include "test_parts.h"

#include "facet_mapping/segmentation/forest_training.h"

namespace facet_mapping::test {
namespace {

using facet_mapping::testing::write_bytes;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// Three fields: reddish and smooth (3), the same mean colour but striped (5), bluish (8). Fields
/// change their places with the seed, so that position alone does not tell them.
TrainingImage striped_fields(int seed) {
  TrainingImage image;
  image.bgr = cv::Mat(kHeight, kWidth, CV_8UC3);
  image.labels = cv::Mat(kHeight, kWidth, CV_16UC1);
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int field = (3 * x / kWidth + seed) % 3;
      const int wave = field == 1 && x % 8 < 4 ? 40 : field == 1 ? -40 : 0;
      const int noise = random.uniform(-8, 9);
      const int red = field == 2 ? 60 : 150;
      const int blue = field == 2 ? 160 : 80;
      image.bgr.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(blue + wave + noise),
                                       cv::saturate_cast<uchar>(90 + wave + noise),
                                       cv::saturate_cast<uchar>(red + wave + noise)};
      image.labels.at<Label>(y, x) = std::array<Label, 3>{3, 5, 8}[field];
    }
  }
  return image;
}

ForestTrainingConfig small_forest() {
  ForestTrainingConfig config;
  config.cells.working_width = kWidth;
  config.trees = 15;
  config.max_samples = 1500;
  return config;
}

ForestModel trained(const ForestTrainingConfig& config = small_forest()) {
  return train_forest({striped_fields(0), striped_fields(1)}, three_classes(), config);
}

double share_equal(const cv::Mat& a, const cv::Mat& b) {
  return 1.0 - static_cast<double>(cv::countNonZero(a != b)) / static_cast<double>(a.total());
}

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class ForestSegmenterTest : public FolderTest {};

TEST_F(ForestSegmenterTest, LearnsColourAndTextureWhereverTheyAre) {
  ForestSegmenter segmenter(trained(), three_classes());
  const TrainingImage unseen = striped_fields(2);
  cv::Mat confidence;
  const cv::Mat labels = segmenter.segment(unseen.bgr, &confidence);
  EXPECT_EQ(labels.type(), CV_16UC1);
  EXPECT_GT(share_equal(labels, unseen.labels), 0.9);
  EXPECT_EQ(confidence.type(), CV_32FC1);
  EXPECT_TRUE(cv::checkRange(confidence, true, nullptr, 0.0, 1.0001));
}

TEST_F(ForestSegmenterTest, TakesImagesOfOtherSizes) {
  ForestSegmenter segmenter(trained(), three_classes());
  const cv::Mat tiny(7, 9, CV_8UC3, cv::Scalar(160, 90, 60));
  EXPECT_EQ(segmenter.segment(tiny).size(), tiny.size());
  const cv::Mat tall(400, 3, CV_8UC3, cv::Scalar(160, 90, 60));
  EXPECT_EQ(segmenter.segment(tall).size(), tall.size());
}

TEST_F(ForestSegmenterTest, UnsurePixelsAreUnlabelled) {
  ForestSegmenterConfig config;
  config.min_confidence = 0.8;
  config.smoothing_cells = 0;
  ForestSegmenter segmenter(trained(), three_classes(), config);
  cv::Mat confidence;
  const cv::Mat labels = segmenter.segment(striped_fields(2).bgr, &confidence);
  const cv::Mat unsure = confidence < config.min_confidence;
  EXPECT_GT(cv::countNonZero(unsure), 0);
  EXPECT_EQ(cv::countNonZero((labels == kUnlabelled) != unsure), 0);
}

TEST_F(ForestSegmenterTest, SameSeedSameFileAndTheFileGivesTheSameLabels) {
  const ForestModel model = trained();
  save_forest(model, file("a.forest"));
  save_forest(trained(), file("b.forest"));
  EXPECT_EQ(bytes_of(file("a.forest")), bytes_of(file("b.forest")));
  ForestTrainingConfig other = small_forest();
  other.seed = 2;
  save_forest(trained(other), file("c.forest"));
  EXPECT_NE(bytes_of(file("a.forest")), bytes_of(file("c.forest")));

  ForestSegmenter before(model, three_classes());
  ForestSegmenter after(load_forest(file("a.forest")), three_classes());
  const cv::Mat image = striped_fields(2).bgr;
  EXPECT_EQ(share_equal(before.segment(image), after.segment(image)), 1.0);
}

TEST_F(ForestSegmenterTest, DamagedFilesAreRefused) {
  save_forest(trained(), file("whole.forest"));
  const std::string whole = bytes_of(file("whole.forest"));
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  for (const std::string& bytes : {std::string(),
                                   whole.substr(0, 10),
                                   whole.substr(0, 21),
                                   whole.substr(0, 25),
                                   whole.substr(0, whole.size() - 1),
                                   whole + "x",
                                   flipped}) {
    write_bytes(file("damaged.forest"), bytes);
    const std::string sentence =
        sentence_of<std::runtime_error>([&] { load_forest(file("damaged.forest")); });
    EXPECT_TRUE(contains(sentence, "damaged.forest") && contains(sentence, "train it anew"))
        << bytes.size() << ": " << sentence;
  }
  EXPECT_TRUE(contains(
      sentence_of<std::runtime_error>([&] { load_forest(file("missing.forest")); }), "no such"));
}

TEST_F(ForestSegmenterTest, AnotherClassListIsRefused) {
  const ForestModel model = trained();
  const LabelSet renamed({make_class(3, "red", {255, 0, 0}),
                          make_class(5, "lime", {0, 255, 0}),
                          make_class(8, "blue", {0, 0, 255})});
  const LabelSet fewer({make_class(3, "red", {255, 0, 0}), make_class(5, "green", {0, 255, 0})});
  const auto refusal = [&](const LabelSet& labels) {
    return sentence_of<std::runtime_error>([&] { ForestSegmenter refused(model, labels); });
  };
  EXPECT_TRUE(contains(refusal(renamed), "'green', which the label list calls 'lime'"));
  EXPECT_TRUE(contains(refusal(fewer), "8 'blue', which the label list does not have"));
}

TEST_F(ForestSegmenterTest, PosesAreUsedIfTrainedWithThem) {
  ForestTrainingConfig config = small_forest();
  config.cells.use_view = true;
  GroundView ground;
  ground.view.camera = {kWidth, kHeight, 100.0, 100.0, 80.0, 60.0};
  ground.up = -Eigen::Vector3d::UnitY();
  ground.ground_m = -1.6;
  TrainingImage image = striped_fields(0);
  EXPECT_THROW(train_forest({image}, three_classes(), config), std::invalid_argument);
  image.ground = ground;
  ForestSegmenter segmenter(train_forest({image}, three_classes(), config), three_classes());
  EXPECT_THROW(segmenter.segment(image.bgr), std::invalid_argument);
  EXPECT_GT(share_equal(segmenter.segment(image.bgr, ground), image.labels), 0.9);
  ground.view.camera.width = 3;
  EXPECT_THROW(segmenter.segment(image.bgr, ground), std::invalid_argument);
}

TEST_F(ForestSegmenterTest, BadTrainingIsRefused) {
  const LabelSet labels = three_classes();
  TrainingImage image = striped_fields(0);
  EXPECT_THROW(train_forest({}, labels, small_forest()), std::invalid_argument);
  image.labels.setTo(3);
  EXPECT_THROW(train_forest({image}, labels, small_forest()), std::invalid_argument);
  image.labels.at<Label>(5, 5) = 77;
  EXPECT_TRUE(contains(
      sentence_of<std::invalid_argument>([&] { train_forest({image}, labels, small_forest()); }),
      "holds class 77"));
  ForestTrainingConfig config = small_forest();
  config.trees = 0;
  EXPECT_THROW(train_forest({striped_fields(0)}, labels, config), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping::test
