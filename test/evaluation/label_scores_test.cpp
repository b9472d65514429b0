// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/label_scores.h"

#include <cmath>
#include <stdexcept>

#include "support/shared_data.h"
#include <gtest/gtest.h>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {
namespace {

cv::Mat row_of(const std::vector<Label>& labels) {
  return cv::Mat(labels, true).reshape(1, 1);
}

constexpr Label kNone = kUnlabelled;

TEST(LabelScores, HandComputed) {
  ConfusionMatrix matrix;
  //                 correct   road as wall   wall correct   wall unseen   no truth
  matrix.add(row_of({0, 0, 0, 1, 1, 1, kNone, 0}), row_of({0, 0, 0, 0, 1, 1, 1, kNone}));
  EXPECT_EQ(matrix.count(0, 0), 3U);
  EXPECT_EQ(matrix.count(0, 1), 1U);
  EXPECT_EQ(matrix.count(1, kNone), 1U);
  EXPECT_EQ(matrix.count(5, 5), 0U);
  const LabelScores scores = matrix.scores(0);
  EXPECT_EQ(scores.pixels, 7U);
  EXPECT_EQ(scores.predicted_pixels, 6U);
  EXPECT_DOUBLE_EQ(scores.accuracy, 5.0 / 7.0);
  ASSERT_EQ(scores.classes.size(), 2U);
  const ClassScores& road = scores.classes[0];
  EXPECT_DOUBLE_EQ(road.precision, 1.0);
  EXPECT_DOUBLE_EQ(road.recall, 0.75);
  EXPECT_DOUBLE_EQ(road.f_score, 6.0 / 7.0);
  EXPECT_DOUBLE_EQ(road.iou, 0.75);
  const ClassScores& wall = scores.classes[1];
  EXPECT_DOUBLE_EQ(wall.precision, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(wall.recall, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(wall.f_score, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(wall.iou, 0.5);
  EXPECT_DOUBLE_EQ(scores.precision, (1.0 + 2.0 / 3.0) / 2);
  EXPECT_DOUBLE_EQ(scores.recall, (0.75 + 2.0 / 3.0) / 2);
  EXPECT_DOUBLE_EQ(scores.f_score, (6.0 / 7.0 + 2.0 / 3.0) / 2);
  EXPECT_DOUBLE_EQ(scores.mean_iou, 0.625);
}

TEST(LabelScores, SmallClassesDoNotEnterTheMeans) {
  ConfusionMatrix matrix;
  matrix.add(row_of({0, 0, 0, 1}), row_of({0, 0, 0, 2}));
  const LabelScores scores = matrix.scores(1);
  EXPECT_EQ(scores.counted_classes, 1U);
  EXPECT_EQ(scores.classes.size(), 2U);  // class 1 is only predicted, class 2 is counted but small
  EXPECT_DOUBLE_EQ(scores.mean_iou, 1.0);
  EXPECT_DOUBLE_EQ(scores.accuracy, 0.75);
  EXPECT_TRUE(std::isnan(matrix.scores(100).recall));
  EXPECT_TRUE(std::isnan(ConfusionMatrix().scores().accuracy));
}

TEST(LabelScores, SumOverViewsEqualsOneLargeView) {
  ConfusionMatrix whole;
  whole.add(row_of({0, 1, 2, 2}), row_of({0, 0, 2, 1}));
  ConfusionMatrix sum;
  ConfusionMatrix part;
  sum.add(row_of({0, 1}), row_of({0, 0}));
  part.add(row_of({2, 2}), row_of({2, 1}));
  sum.add(part);
  for (Label truth = 0; truth < 3; ++truth) {
    for (Label predicted = 0; predicted < 3; ++predicted) {
      EXPECT_EQ(sum.count(truth, predicted), whole.count(truth, predicted));
    }
  }
}

TEST(LabelScores, WrongImagesAreRefused) {
  ConfusionMatrix matrix;
  EXPECT_THROW(matrix.add(cv::Mat(2, 2, CV_8U), cv::Mat(2, 2, CV_16U)), std::invalid_argument);
  EXPECT_THROW(matrix.add(cv::Mat(2, 2, CV_16U), cv::Mat(2, 3, CV_16U)), std::invalid_argument);
}

// The scores that the data's README gives for the network and the forest themselves.
TEST(LabelScores, PublishedScoresOfTheSegmentations) {
  FACET_MAPPING_DATA_OR_SKIP(street, "kitti_labels_03");
  ConfusionMatrix matrix;
  for (const DatasetFrame& frame : read_dataset(street).frames) {
    matrix.add(read_labels(frame.labels), read_labels(frame.gt_labels));
  }
  const LabelScores scores = matrix.scores();
  EXPECT_EQ(scores.counted_classes, 8U);
  EXPECT_NEAR(scores.accuracy, 0.833, 5e-4);
  EXPECT_NEAR(scores.recall, 0.664, 5e-4);
  EXPECT_NEAR(scores.f_score, 0.620, 5e-4);
  EXPECT_NEAR(scores.precision, 0.635, 5e-4);
  EXPECT_NEAR(scores.mean_iou, 0.523, 5e-4);
}

}  // namespace
}  // namespace facet_mapping
