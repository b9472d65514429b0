// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/stereo_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "excluded_labels.h"
#include "pixel_thinning.h"
#include "stereo_checks.h"
#include "subpixel.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

/// What the disparity of a pixel says about its depth.
struct Triangulation {
  double focal_times_baseline = 0.0;  // pixels * metres
  double disparity_sigma = 0.0;       // pixels
  double min_depth = 0.0;             // metres
  double max_depth = 0.0;             // metres
  double max_relative_sigma = 0.0;

  Triangulation(const PinholeCamera& camera, double baseline_m, const StereoConfig& config)
      : focal_times_baseline(camera.fx * baseline_m),
        disparity_sigma(config.disparity_sigma_px),
        min_depth(config.min_depth_m),
        max_depth(config.max_depth_m),
        max_relative_sigma(config.max_relative_sigma) {}

  double depth(double disparity) const { return focal_times_baseline / disparity; }
  double sigma(double depth, double doubt) const {
    return depth * depth * disparity_sigma * doubt / focal_times_baseline;
  }
  bool in_range(double depth, double doubt) const {
    return depth >= min_depth && depth <= max_depth &&
           sigma(depth, doubt) <= max_relative_sigma * depth;
  }
};

/// Non-zero where a pixel may become a point.
cv::Mat find_usable(const cv::Mat& disparity,
                    const cv::Mat& labels,
                    const Triangulation& triangulation,
                    const StereoConfig& config) {
  cv::Mat usable =
      detail::find_depth_edges(disparity, config.edge_jump_px, config.edge_margin_px) == 0;
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* disparity_row = disparity.ptr<float>(y);
    const auto* label_row = labels.empty() ? nullptr : labels.ptr<Label>(y);
    auto* usable_row = usable.ptr<std::uint8_t>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      const bool in_range =
          disparity_row[x] > 0.0F &&
          triangulation.in_range(triangulation.depth(disparity_row[x]), detail::kLeastDoubt);
      if (!in_range ||
          (label_row != nullptr && detail::is_excluded(label_row[x], config.excluded_labels))) {
        usable_row[x] = 0;
      }
    }
  }
  return usable;
}

std::vector<detail::RefinedDisparity> refine_all(const cv::Mat& left,
                                                 const cv::Mat& right,
                                                 const cv::Mat& disparity,
                                                 const std::vector<cv::Point>& pixels) {
  std::vector<detail::RefinedDisparity> refined(pixels.size());
  tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
    refined[i] = detail::refine_disparity(left, right, disparity, pixels[i]);
  });
  return refined;
}

std::vector<LabeledPoint> triangulate(const std::vector<cv::Point>& pixels,
                                      const std::vector<detail::RefinedDisparity>& disparities,
                                      const cv::Mat& labels,
                                      const PinholeCamera& camera,
                                      const Triangulation& triangulation) {
  std::vector<LabeledPoint> points;
  points.reserve(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double depth = triangulation.depth(disparities[i].disparity);
    const double doubt = disparities[i].doubt;
    if (!triangulation.in_range(depth, doubt)) {
      continue;  // NaN too: the refinement found no likeness
    }
    LabeledPoint point;
    point.position = (depth * camera.ray({pixels[i].x, pixels[i].y})).cast<float>();
    point.label = labels.empty() ? kUnlabelled : labels.at<Label>(pixels[i]);
    point.sigma = static_cast<float>(triangulation.sigma(depth, doubt));
    points.push_back(point);
  }
  return points;
}

}  // namespace

std::vector<LabeledPoint> stereo_points(const cv::Mat& left,
                                        const cv::Mat& right,
                                        const cv::Mat& labels,
                                        const PinholeCamera& camera,
                                        double baseline_m,
                                        const StereoConfig& config,
                                        StereoReport* report) {
  detail::check_stereo_config(config);
  detail::check_stereo_pair(left, right);
  if (report != nullptr) {
    *report = {};
  }
  if (left.empty()) {
    return {};
  }
  detail::check_stereo_geometry(left, labels, camera, baseline_m);
  const cv::Mat disparity = stereo_disparity(left, right, config);
  const Triangulation triangulation(camera, baseline_m, config);
  const std::vector<cv::Point> pixels =
      detail::thin_pixels(find_usable(disparity, labels, triangulation, config),
                          detail::gradient_magnitude(left),
                          {config.cell_px, config.flat_cell_px, config.min_gradient});
  std::vector<LabeledPoint> points = triangulate(
      pixels, refine_all(left, right, disparity, pixels), labels, camera, triangulation);
  if (report != nullptr) {
    report->matched_pixels = static_cast<std::size_t>(cv::countNonZero(disparity > 0.0));
    report->points = points.size();
  }
  return points;
}

}  // namespace facet_mapping
