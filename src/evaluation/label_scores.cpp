// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/label_scores.h"

#include <limits>
#include <stdexcept>

namespace facet_mapping {
namespace {

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void finish(ClassScores& scores) {
  scores.precision = ratio(scores.correct_pixels, scores.predicted_pixels);
  scores.recall = ratio(scores.correct_pixels, scores.truth_pixels);
  scores.f_score = ratio(2 * scores.correct_pixels, scores.truth_pixels + scores.predicted_pixels);
  scores.iou = ratio(scores.correct_pixels,
                     scores.truth_pixels + scores.predicted_pixels - scores.correct_pixels);
}

// Means over the classes that are large enough to tell.
void average(std::size_t min_pixels, LabelScores& scores) {
  for (const ClassScores& one : scores.classes) {
    if (one.truth_pixels > min_pixels) {
      ++scores.counted_classes;
      scores.precision += one.precision;
      scores.recall += one.recall;
      scores.f_score += one.f_score;
      scores.mean_iou += one.iou;
    }
  }
  const double scale = scores.counted_classes == 0
                           ? std::numeric_limits<double>::quiet_NaN()
                           : 1.0 / static_cast<double>(scores.counted_classes);
  scores.precision *= scale;
  scores.recall *= scale;
  scores.f_score *= scale;
  scores.mean_iou *= scale;
}

}  // namespace

void ConfusionMatrix::add(const cv::Mat& predicted, const cv::Mat& truth) {
  if (predicted.type() != CV_16UC1 || truth.type() != CV_16UC1 ||
      predicted.size() != truth.size()) {
    throw std::invalid_argument("label scores: both images must be CV_16UC1 of one size");
  }
  Label last_truth = kUnlabelled;
  Label last_predicted = kUnlabelled;
  std::size_t* cell = nullptr;  // neighbouring pixels mostly hit the same cell
  for (int row = 0; row < truth.rows; ++row) {
    for (int column = 0; column < truth.cols; ++column) {
      const Label true_label = truth.at<Label>(row, column);
      const Label predicted_label = predicted.at<Label>(row, column);
      if (true_label == kUnlabelled) {
        continue;
      }
      if (cell == nullptr || true_label != last_truth || predicted_label != last_predicted) {
        cell = &counts_[true_label][predicted_label];
        last_truth = true_label;
        last_predicted = predicted_label;
      }
      ++*cell;
    }
  }
}

void ConfusionMatrix::add(const ConfusionMatrix& other) {
  for (const auto& [truth, row] : other.counts_) {
    for (const auto& [predicted, pixels] : row) {
      counts_[truth][predicted] += pixels;
    }
  }
}

std::size_t ConfusionMatrix::count(Label truth, Label predicted) const {
  const auto row = counts_.find(truth);
  if (row == counts_.end()) {
    return 0;
  }
  const auto cell = row->second.find(predicted);
  return cell == row->second.end() ? 0 : cell->second;
}

LabelScores ConfusionMatrix::scores(std::size_t min_pixels) const {
  LabelScores scores;
  std::map<Label, ClassScores> classes;
  std::size_t correct = 0;
  for (const auto& [truth, row] : counts_) {
    classes[truth].id = truth;
    for (const auto& [predicted, pixels] : row) {
      classes[truth].truth_pixels += pixels;
      classes[predicted].predicted_pixels += pixels;
      scores.pixels += pixels;
      scores.predicted_pixels += predicted == kUnlabelled ? 0 : pixels;
    }
    classes[truth].correct_pixels = count(truth, truth);
    correct += classes[truth].correct_pixels;
  }
  for (auto& [id, one] : classes) {
    if (one.truth_pixels > 0) {
      finish(one);
      scores.classes.push_back(one);
    }
  }
  scores.accuracy =
      scores.pixels == 0 ? std::numeric_limits<double>::quiet_NaN() : ratio(correct, scores.pixels);
  average(min_pixels, scores);
  return scores;
}

}  // namespace facet_mapping
