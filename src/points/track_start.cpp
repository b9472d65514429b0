// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "track_start.h"

#include <algorithm>
#include <cmath>

#include "pixel_thinning.h"
#include <opencv2/imgproc.hpp>

namespace facet_mapping::detail {
namespace {

constexpr int kEvenWindowPx = 31;
constexpr double kEvenContrast = 40.0;  ///< grey values that one standard deviation becomes
constexpr double kNoiseContrast = 4.0;  ///< weaker contrast is taken for noise and not raised
constexpr int kCornerBlockPx = 5;

cv::Rect cell_around(const Eigen::Vector2d& pixel, int cell_px) {
  return {static_cast<int>(std::lround(pixel.x())) - cell_px / 2,
          static_cast<int>(std::lround(pixel.y())) - cell_px / 2,
          cell_px,
          cell_px};
}

/// Non-zero where the classes and the border let features start.
cv::Mat allowed_mask(const cv::Size& size, const cv::Mat& labels, const TrackConfig& config) {
  cv::Mat mask(size, CV_8UC1, cv::Scalar(0));
  const int border = config.patch_radius_px + 2;
  const cv::Rect inner =
      cv::Rect(border, border, size.width - 2 * border, size.height - 2 * border);
  if (inner.width <= 0 || inner.height <= 0) {
    return mask;
  }
  mask(inner).setTo(255);
  for (const Label label : labels.empty() ? std::vector<Label>() : config.excluded_labels) {
    mask.setTo(0, labels == label);
  }
  return mask;
}

void block(const std::vector<Eigen::Vector2d>& pixels, int cell_px, cv::Mat* mask) {
  const cv::Rect all(0, 0, mask->cols, mask->rows);
  for (const Eigen::Vector2d& pixel : pixels) {
    (*mask)(cell_around(pixel, cell_px) & all).setTo(0);
  }
}

}  // namespace

cv::Mat even_image(const cv::Mat& gray) {
  const cv::Size window(kEvenWindowPx, kEvenWindowPx);
  cv::Mat values;
  gray.convertTo(values, CV_32F);
  cv::Mat mean;
  cv::Mat squares;
  cv::boxFilter(values, mean, CV_32F, window);
  cv::boxFilter(values.mul(values), squares, CV_32F, window);
  cv::Mat contrast = cv::max(squares - mean.mul(mean), 0.0);
  cv::sqrt(contrast, contrast);
  cv::Mat even = (values - mean) / (contrast + kNoiseContrast);
  cv::Mat result;
  even.convertTo(result, CV_8U, kEvenContrast, 128.0);
  return result;
}

Eigen::Vector2d edge_normal(const cv::Mat& gray, const Eigen::Vector2d& pixel) {
  const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 1, gray.cols - 2);
  const int y = std::clamp(static_cast<int>(std::lround(pixel.y())), 1, gray.rows - 2);
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(gray.at<std::uint8_t>(y + dy, x + dx));
  };
  const Eigen::Vector2d gradient(
      at(1, -1) + 2.0 * at(1, 0) + at(1, 1) - at(-1, -1) - 2.0 * at(-1, 0) - at(-1, 1),
      at(-1, 1) + 2.0 * at(0, 1) + at(1, 1) - at(-1, -1) - 2.0 * at(0, -1) - at(1, -1));
  const double length = gradient.norm();
  return length > 0.0 ? Eigen::Vector2d(gradient / length) : Eigen::Vector2d::Zero();
}

NewFeatures find_features(const cv::Mat& gray,
                          const cv::Mat& even,
                          const cv::Mat& labels,
                          const std::vector<Eigen::Vector2d>& taken,
                          const TrackConfig& config) {
  NewFeatures features;
  const cv::Mat allowed = allowed_mask(gray.size(), labels, config);
  if (cv::countNonZero(allowed) == 0) {
    return features;
  }
  const cv::Mat gradient = gradient_magnitude(gray);
  cv::Mat usable = allowed & (gradient >= config.min_gradient);
  block(taken, config.corner_cell_px, &usable);
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(
      even, corners, 0, config.min_corner, config.corner_cell_px, usable, kCornerBlockPx);
  for (const cv::Point2f& corner : corners) {
    features.corners.emplace_back(corner.x, corner.y);
  }
  usable = allowed & (gradient >= config.min_gradient);
  block(taken, config.edge_cell_px, &usable);
  block(features.corners, config.edge_cell_px, &usable);
  for (const cv::Point& edge :
       thin_pixels(usable, gradient, {config.edge_cell_px, config.edge_cell_px, 0.0})) {
    features.edges.emplace_back(edge.x, edge.y);
  }
  return features;
}

}  // namespace facet_mapping::detail
