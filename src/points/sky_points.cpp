// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/sky_points.h"

#include <algorithm>
#include <stdexcept>

namespace facet_mapping {
namespace {

void check(const cv::Mat& labels, const PinholeCamera& camera, const SkyConfig& config) {
  if (config.cell_px < 0 || !(config.range_m > 0.0)) {
    throw std::invalid_argument("sky points: cell_px must be 0 or more and range_m positive");
  }
  if (!labels.empty() &&
      (labels.type() != CV_16UC1 || labels.cols != camera.width || labels.rows != camera.height)) {
    throw std::invalid_argument("sky points: labels must be 16-bit ids of the camera's image size");
  }
}

// One wrong pixel could carve a street lamp away: the whole square has to agree.
bool is_sky(const cv::Mat& square, const std::vector<Label>& sky) {
  return std::all_of(square.begin<Label>(), square.end<Label>(), [&sky](Label label) {
    return std::find(sky.begin(), sky.end(), label) != sky.end();
  });
}

}  // namespace

std::vector<LabeledPoint> sky_points(const cv::Mat& labels,
                                     const PinholeCamera& camera,
                                     const std::vector<Label>& sky,
                                     const SkyConfig& config) {
  check(labels, camera, config);
  std::vector<LabeledPoint> points;
  if (labels.empty() || sky.empty() || config.cell_px == 0) {
    return points;
  }
  const int side = config.cell_px;
  for (int y = 0; y + side <= labels.rows; y += side) {
    for (int x = 0; x + side <= labels.cols; x += side) {
      if (!is_sky(labels(cv::Rect(x, y, side, side)), sky)) {
        continue;
      }
      LabeledPoint point;
      const Eigen::Vector2d pixel(x + side / 2, y + side / 2);
      point.position = (config.range_m * camera.ray(pixel).normalized()).cast<float>();
      point.label = labels.at<Label>(y + side / 2, x + side / 2);
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace facet_mapping
