// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/semantic_gate.h"

#include <algorithm>
#include <set>

#include <opencv2/imgproc.hpp>

namespace facet_mapping {
namespace {

std::set<Label> classes_in(const cv::Mat& rendered) {
  std::vector<std::uint8_t> present(kUnlabelled, 0);
  for (int y = 0; y < rendered.rows; ++y) {
    for (int x = 0; x < rendered.cols; ++x) {
      const Label label = rendered.at<Label>(y, x);
      if (label != kUnlabelled) {
        present[label] = 1;
      }
    }
  }
  std::set<Label> classes;
  for (std::size_t l = 0; l < present.size(); ++l) {
    if (present[l] != 0) {
      classes.insert(static_cast<Label>(l));
    }
  }
  return classes;
}

/// CV_8UC1: 1 where the window has pixels in and out of the class, beyond the image counting as
/// neither.
cv::Mat border_zone(const cv::Mat& rendered, Label label, int window_px) {
  const cv::Mat mask = (rendered == static_cast<double>(label)) / 255;
  const cv::Mat kernel = cv::Mat::ones(window_px, window_px, CV_8UC1);
  cv::Mat any;
  cv::Mat all;
  cv::dilate(mask, any, kernel);
  cv::erode(mask, all, kernel);
  return any - all;
}

struct ClassWeights {
  Label label;
  cv::Mat weight;  // CV_32FC1
};

}  // namespace

SemanticGate::SemanticGate(const cv::Mat& rendered, int window_px) {
  std::vector<ClassWeights> classes;
  const cv::Size window(window_px, window_px);
  for (const Label label : classes_in(rendered)) {
    const cv::Mat zone = border_zone(rendered, label, window_px);
    const int count = cv::countNonZero(zone);
    if (count == 0) {
      continue;
    }
    size_ += static_cast<std::size_t>(count);
    classes.push_back({label, {}});
    cv::boxFilter(
        zone, classes.back().weight, CV_32F, window, cv::Point(-1, -1), true, cv::BORDER_CONSTANT);
  }
  offsets_.push_back(0);
  for (int y = 0; y < rendered.rows; ++y) {
    for (int x = 0; x < rendered.cols; ++x) {
      for (const ClassWeights& c : classes) {
        const float weight = c.weight.at<float>(y, x);
        if (weight > 0.0F) {
          entries_.push_back({c.label, weight});
        }
      }
      if (entries_.size() > offsets_.back()) {
        pixels_.push_back(static_cast<std::uint32_t>(y * rendered.cols + x));
        offsets_.push_back(static_cast<std::uint32_t>(entries_.size()));
      }
    }
  }
}

double SemanticGate::row_weight(std::size_t row, Label label) const {
  for (std::uint32_t k = offsets_[row]; k < offsets_[row + 1]; ++k) {
    if (entries_[k].label == label) {
      return entries_[k].weight;
    }
  }
  return 0.0;
}

double SemanticGate::row_cost(std::size_t row, Label shown, Label seen) const {
  if (seen == kUnlabelled || shown == seen) {
    return 0.0;
  }
  return row_weight(row, shown) + row_weight(row, seen);
}

double SemanticGate::weight(std::uint32_t pixel, Label label) const {
  const auto found = std::lower_bound(pixels_.begin(), pixels_.end(), pixel);
  if (found == pixels_.end() || *found != pixel) {
    return 0.0;
  }
  return row_weight(static_cast<std::size_t>(found - pixels_.begin()), label);
}

double SemanticGate::cost(std::uint32_t pixel, Label shown, Label seen) const {
  if (seen == kUnlabelled || shown == seen) {
    return 0.0;
  }
  return weight(pixel, shown) + weight(pixel, seen);
}

double SemanticGate::energy(const cv::Mat& rendered, const cv::Mat& segmentation) const {
  double sum = 0.0;
  for (std::size_t row = 0; row < pixels_.size(); ++row) {
    const int y = static_cast<int>(pixels_[row]) / rendered.cols;
    const int x = static_cast<int>(pixels_[row]) % rendered.cols;
    sum += row_cost(row, rendered.at<Label>(y, x), segmentation.at<Label>(y, x));
  }
  return sum;
}

}  // namespace facet_mapping
