// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How well class images agree with ground truth.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping {

/// One class against all others.
struct ClassScores {
  Label id = 0;
  std::size_t truth_pixels = 0;      ///< pixels of this class in the ground truth
  std::size_t predicted_pixels = 0;  ///< pixels of this class in the prediction
  std::size_t correct_pixels = 0;    ///< in both
  double precision = 0.0;            ///< correct / predicted, 0 where nothing is predicted
  double recall = 0.0;               ///< correct / truth
  double f_score = 0.0;              ///< harmonic mean of the two
  double iou = 0.0;                  ///< correct / (truth or predicted)
};

struct LabelScores {
  std::size_t pixels = 0;  ///< with a ground-truth class
  std::size_t predicted_pixels =
      0;                   ///< of these, with a predicted class; the others count as wrong
  double accuracy = 0.0;   ///< correct / pixels, NaN without pixels
  double precision = 0.0;  ///< these four: means over the counted classes, NaN without any
  double recall = 0.0;
  double f_score = 0.0;
  double mean_iou = 0.0;
  std::size_t counted_classes = 0;   ///< classes with more than `min_pixels` ground-truth pixels
  std::vector<ClassScores> classes;  ///< all classes of the ground truth, ascending ids
};

/// Counts pixels over any number of views.
class ConfusionMatrix {
 public:
  /// Both CV_16UC1 of one size; pixels whose truth is kUnlabelled do not count.
  /// Throws std::invalid_argument on other images.
  void add(const cv::Mat& predicted, const cv::Mat& truth);

  /// Adds all pixels of another matrix.
  void add(const ConfusionMatrix& other);

  std::size_t count(Label truth, Label predicted) const;

  /// Classes with more than `min_pixels` ground-truth pixels enter the means.
  LabelScores scores(std::size_t min_pixels = 100) const;

 private:
  std::map<Label, std::map<Label, std::size_t>> counts_;  // truth -> predicted -> pixels
};

}  // namespace facet_mapping
