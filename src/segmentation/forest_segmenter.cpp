// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/segmentation/forest_segmenter.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "cell_features.h"
#include "guided_upsampling.h"
#include <opencv2/imgproc.hpp>

namespace facet_mapping {
namespace {

void check_classes(const ForestModel& model, const LabelSet& labels) {
  for (const ForestClass& known : model.classes) {
    const ClassInfo* info = labels.find(known.id);
    if (info == nullptr || info->name != known.name) {
      throw std::runtime_error("The forest was trained for class " + std::to_string(known.id) +
                               " '" + known.name + "', which the label list " +
                               (info == nullptr ? "does not have" : "calls '" + info->name + "'") +
                               "; use the list it was trained with, or train it anew");
    }
  }
}

void check_config(const ForestSegmenterConfig& config) {
  if (config.smoothing_cells < 0 || config.smoothing_cells > 100 ||
      !(config.smoothing_edge > 0.0) ||
      !(config.min_confidence >= 0.0 && config.min_confidence <= 1.0)) {
    throw std::invalid_argument(
        "A forest's smoothing must be 0 to 100 cells, its edge above 0, the least confidence 0 to "
        "1");
  }
}

cv::Mat gray_of(const cv::Mat& bgr) {
  cv::Mat gray;
  cv::cvtColor(bgr, gray, cv::COLOR_BGR2GRAY);
  gray.convertTo(gray, CV_32F, 1.0 / 255.0);
  return gray;
}

/// Keeps, pixel by pixel, the best of the classes shown so far.
class BestClass {
 public:
  explicit BestClass(const cv::Size& size)
      : labels_(size, CV_16UC1, cv::Scalar(kUnlabelled)),
        best_(size, CV_32FC1, cv::Scalar(-1.0)),
        sum_(size, CV_32FC1, cv::Scalar(0.0)) {}

  void show(Label id, cv::Mat probability) {
    probability = cv::max(probability, 0.0);  // the filter overshoots at edges
    sum_ += probability;
    const cv::Mat better = probability > best_;
    labels_.setTo(id, better);
    probability.copyTo(best_, better);
  }

  const cv::Mat& labels() const { return labels_; }
  cv::Mat confidence() const { return best_ / cv::max(sum_, 1e-6); }

 private:
  cv::Mat labels_;
  cv::Mat best_;
  cv::Mat sum_;
};

}  // namespace

ForestSegmenter::ForestSegmenter(ForestModel model,
                                 const LabelSet& labels,
                                 const ForestSegmenterConfig& config)
    : Segmenter(config.min_confidence), model_(std::move(model)), config_(config) {
  check_classes(model_, labels);
  check_config(config_);
}

std::vector<cv::Mat> ForestSegmenter::cell_probabilities(const cv::Mat& features,
                                                         const cv::Size& cells) const {
  std::vector<cv::Mat> planes(model_.classes.size());
  for (cv::Mat& plane : planes) {
    plane.create(cells, CV_32FC1);
  }
  cv::parallel_for_(cv::Range(0, cells.height), [&](const cv::Range& range) {
    std::vector<float> votes(planes.size());
    for (int k = range.start * cells.width; k < range.end * cells.width; ++k) {
      std::fill(votes.begin(), votes.end(), 0.0F);
      const float sum = model_.add_votes(features.ptr<float>(k), votes.data());
      for (std::size_t c = 0; c < planes.size(); ++c) {
        planes[c].ptr<float>()[k] = votes[c] / sum;
      }
    }
  });
  return planes;
}

cv::Mat ForestSegmenter::run(const cv::Mat& bgr, const GroundView* ground, cv::Mat* confidence) {
  const cv::Size cells = detail::cell_grid(bgr.size(), model_.cells);
  const cv::Mat features = detail::cell_features(bgr, ground, model_.cells);
  const std::vector<cv::Mat> planes = cell_probabilities(features, cells);
  const detail::GuidedUpsampling guide(
      gray_of(bgr), cells, std::max(1, config_.smoothing_cells), config_.smoothing_edge);
  BestClass best(bgr.size());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    cv::Mat plane;
    if (config_.smoothing_cells > 0) {
      plane = guide.upsample(planes[c]);
    } else {
      cv::resize(planes[c], plane, bgr.size(), 0.0, 0.0, cv::INTER_LINEAR);
    }
    best.show(model_.classes[c].id, plane);
  }
  *confidence = best.confidence();
  return best.labels();
}

}  // namespace facet_mapping
