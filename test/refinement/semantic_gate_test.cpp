// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/semantic_gate.h"

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

/// Class 1 left of column `column`, class 2 right of it.
cv::Mat two_classes(int rows, int cols, int column) {
  cv::Mat image(rows, cols, CV_16UC1, cv::Scalar(2));
  image.colRange(0, column).setTo(cv::Scalar(1));
  return image;
}

/// The definition, pixel by pixel: sum_l sum_u chi_l(u) sum_{w in W(u)} (M2 - M3)^2 / |W|.
double energy_by_definition(const cv::Mat& rendered, const cv::Mat& seen, int window, int classes) {
  const int r = window / 2;
  double sum = 0.0;
  for (int l = 0; l < classes; ++l) {
    for (int y = 0; y < rendered.rows; ++y) {
      for (int x = 0; x < rendered.cols; ++x) {
        int in = 0;
        int all = 0;
        int wrong = 0;
        for (int v = std::max(0, y - r); v <= std::min(rendered.rows - 1, y + r); ++v) {
          for (int u = std::max(0, x - r); u <= std::min(rendered.cols - 1, x + r); ++u) {
            const bool m3 = rendered.at<Label>(v, u) == l;
            const bool m2 = seen.at<Label>(v, u) == l;
            in += m3 ? 1 : 0;
            ++all;
            wrong += m3 != m2 && seen.at<Label>(v, u) != kUnlabelled ? 1 : 0;
          }
        }
        sum += in > 0 && in < all ? wrong : 0;
      }
    }
  }
  return sum / (window * window);
}

TEST(SemanticGate, EnergyIsThatOfTheDefinition) {
  cv::RNG random(3);
  for (int round = 0; round < 5; ++round) {
    cv::Mat rendered(24, 30, CV_16UC1);
    cv::Mat seen(24, 30, CV_16UC1);
    for (int y = 0; y < rendered.rows; ++y) {
      for (int x = 0; x < rendered.cols; ++x) {
        rendered.at<Label>(y, x) = static_cast<Label>((x / 9 + y / 11) % 3);
        seen.at<Label>(y, x) = static_cast<Label>(random.uniform(0, 4));
        if (seen.at<Label>(y, x) == 3) {
          seen.at<Label>(y, x) = kUnlabelled;
        }
      }
    }
    rendered.rowRange(0, 4).setTo(cv::Scalar(kUnlabelled));
    for (const int window : {3, 7}) {
      const SemanticGate gate(rendered, window);
      EXPECT_NEAR(
          gate.energy(rendered, seen), energy_by_definition(rendered, seen, window, 3), 1e-3);
    }
  }
}

TEST(SemanticGate, LooksOnlyNearBorders) {
  const SemanticGate gate(two_classes(40, 60, 30), 5);
  EXPECT_EQ(gate.weight(20 * 60 + 10, 1), 0.0);
  EXPECT_GT(gate.weight(20 * 60 + 29, 1), 0.5);
  EXPECT_GT(gate.weight(20 * 60 + 30, 2), 0.5);
  EXPECT_EQ(gate.weight(20 * 60 + 30, 7), 0.0);
  EXPECT_EQ(gate.size(), 2U * 40U * 4U);
}

TEST(SemanticGate, IsEmptyForOneClass) {
  const cv::Mat all_one(10, 10, CV_16UC1, cv::Scalar(1));
  const SemanticGate gate(all_one, 5);
  EXPECT_EQ(gate.size(), 0U);
  EXPECT_EQ(gate.energy(all_one, cv::Mat(10, 10, CV_16UC1, cv::Scalar(2))), 0.0);
}

TEST(SemanticGate, PixelsWithoutSegmentationCostNothing) {
  const SemanticGate gate(two_classes(40, 60, 30), 5);
  EXPECT_EQ(gate.cost(20 * 60 + 30, 1, kUnlabelled), 0.0);
  EXPECT_EQ(gate.cost(20 * 60 + 30, 2, 2), 0.0);
  EXPECT_GT(gate.cost(20 * 60 + 30, 1, 2), 0.0);
}

}  // namespace
}  // namespace facet_mapping
