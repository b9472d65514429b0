// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/depth_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace facet_mapping {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kTrimMedians = 10.0;

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? kUnknown : static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<double> shares(const std::vector<std::size_t>& parts, std::size_t whole) {
  std::vector<double> result;
  result.reserve(parts.size());
  for (const std::size_t part : parts) {
    result.push_back(share(part, whole));
  }
  return result;
}

// Of an even number of values the mean of the middle two.
double median_of(std::vector<float> values) {
  if (values.empty()) {
    return kUnknown;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) {
    return *middle;
  }
  return (static_cast<double>(*std::max_element(values.begin(), middle)) + *middle) / 2.0;
}

struct Moments {
  std::size_t count = 0;
  double mean = kUnknown;  ///< of the errors
  double mae = kUnknown;
  double rms = kUnknown;
};

Moments moments_below(const std::vector<float>& errors, double bound) {
  Moments moments;
  double sum = 0.0;
  double sum_absolute = 0.0;
  double sum_squares = 0.0;
  for (const float error : errors) {
    const double value = error;
    if (std::abs(value) <= bound) {
      ++moments.count;
      sum += value;
      sum_absolute += std::abs(value);
      sum_squares += value * value;
    }
  }
  if (moments.count > 0) {
    const auto count = static_cast<double>(moments.count);
    moments.mean = sum / count;
    moments.mae = sum_absolute / count;
    moments.rms = std::sqrt(sum_squares / count);
  }
  return moments;
}

}  // namespace

void DepthErrors::add_pixel(float rendered, float truth) {
  if (!(truth > 0.0F) || truth > options_.max_depth_m) {
    return;
  }
  ++truth_pixels_;
  if (!(rendered > 0.0F)) {
    return;
  }
  ++covered_pixels_;
  const double error = static_cast<double>(rendered) - static_cast<double>(truth);
  const double magnitude = std::abs(error);
  if (magnitude < options_.max_error_m) {
    errors_.push_back(static_cast<float>(error));
  }
  for (std::size_t k = 0; k < within_absolute_.size(); ++k) {
    within_absolute_[k] += magnitude < options_.absolute_bounds_m[k] ? 1 : 0;
  }
  for (std::size_t k = 0; k < within_relative_.size(); ++k) {
    within_relative_[k] += magnitude < options_.relative_bounds[k] * truth ? 1 : 0;
  }
}

void DepthErrors::add(const cv::Mat& rendered, const cv::Mat& truth) {
  if (rendered.type() != CV_32FC1 || truth.type() != CV_32FC1 || rendered.size() != truth.size()) {
    throw std::invalid_argument(
        "depth error: rendered and true depth must be CV_32FC1 images of one size");
  }
  for (int row = 0; row < truth.rows; ++row) {
    const auto* rendered_row = rendered.ptr<float>(row);
    const auto* truth_row = truth.ptr<float>(row);
    for (int column = 0; column < truth.cols; ++column) {
      add_pixel(rendered_row[column], truth_row[column]);
    }
  }
}

void DepthErrors::add(const DepthErrors& other) {
  truth_pixels_ += other.truth_pixels_;
  covered_pixels_ += other.covered_pixels_;
  errors_.insert(errors_.end(), other.errors_.begin(), other.errors_.end());
  for (std::size_t k = 0; k < within_absolute_.size(); ++k) {
    within_absolute_[k] += other.within_absolute_.at(k);
  }
  for (std::size_t k = 0; k < within_relative_.size(); ++k) {
    within_relative_[k] += other.within_relative_.at(k);
  }
}

DepthScores DepthErrors::scores() const {
  DepthScores scores;
  scores.truth_pixels = truth_pixels_;
  scores.covered_pixels = covered_pixels_;
  scores.counted_pixels = errors_.size();
  scores.completeness = share(covered_pixels_, truth_pixels_);
  std::vector<float> magnitudes(errors_.size());
  std::transform(errors_.begin(), errors_.end(), magnitudes.begin(), [](float error) {
    return std::abs(error);
  });
  scores.median_m = median_of(std::move(magnitudes));
  const Moments all = moments_below(errors_, std::numeric_limits<double>::infinity());
  scores.mae_m = all.mae;
  scores.rms_m = all.rms;
  scores.bias_m = all.mean;
  const Moments trimmed = moments_below(errors_, kTrimMedians * scores.median_m);
  scores.trimmed_mae_m = trimmed.mae;
  scores.trimmed_rms_m = trimmed.rms;
  scores.trimmed_share = share(errors_.size() - trimmed.count, errors_.size());
  scores.within_absolute = shares(within_absolute_, truth_pixels_);
  scores.within_relative = shares(within_relative_, truth_pixels_);
  return scores;
}

}  // namespace facet_mapping
