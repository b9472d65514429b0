// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/point_quality.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "facet_mapping/evaluation/mesh_evaluation.h"
#include "facet_mapping/evaluation/scan_depth.h"
#include "facet_mapping/geometry/median.h"

namespace facet_mapping {
namespace {

constexpr double kSeenTolerance = 0.02;       // of depth: of the same surface as what is in front
constexpr double kGaussianMedian = 0.674490;  // median |error| of Gaussian noise, in sigmas

void check_image(const cv::Mat& image, int type, const View& view, const std::string& what) {
  if (!image.empty() && (image.type() != type || image.cols != view.camera.width ||
                         image.rows != view.camera.height)) {
    throw std::invalid_argument("point quality: the " + what +
                                " must have one channel of the documented type and the size of "
                                "the view's camera");
  }
}

void check(const PointFrame& frame, const PointTruth& truth) {
  if (!truth.view.camera.is_valid() || !is_rigid(truth.view.world_from_cam) ||
      !is_rigid(frame.world_from_sensor)) {
    throw std::invalid_argument(
        "point quality: a camera without size or focal length, or a pose "
        "that is not rigid");
  }
  check_image(truth.depth, CV_32FC1, truth.view, "true depth");
  check_image(truth.seen, CV_32FC1, truth.view, "seen depth");
  check_image(truth.labels, CV_16UC1, truth.view, "labels");
}

/// The pixel that a point falls on, {-1, -1} outside the image.
cv::Point pixel_of(const Eigen::Vector3d& in_view, const PinholeCamera& camera) {
  if (!in_view.allFinite() || in_view.z() <= 0.0) {
    return {-1, -1};
  }
  const Eigen::Vector2d pixel = camera.project(in_view);
  const bool is_inside = pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < camera.width - 0.5 &&
                         pixel.y() < camera.height - 0.5;
  return is_inside ? cv::Point(static_cast<int>(std::lround(std::max(0.0, pixel.x()))),
                               static_cast<int>(std::lround(std::max(0.0, pixel.y()))))
                   : cv::Point(-1, -1);
}

bool is_hidden(const cv::Mat& seen, const cv::Point& pixel, double depth) {
  return !seen.empty() && !(std::abs(seen.at<float>(pixel) - depth) <= kSeenTolerance * depth);
}

double ratio(double part, std::size_t whole) {
  return whole > 0 ? part / static_cast<double>(whole) : NAN;
}

double median_or_nan(const std::vector<float>& values) {
  return values.empty() ? NAN : median(values);
}

double mean(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) {
    sum += value;
  }
  return ratio(sum, values.size());
}

double share_within(const std::vector<float>& values, double bound) {
  return ratio(static_cast<double>(std::count_if(
                   values.begin(), values.end(), [bound](float v) { return v <= bound; })),
               values.size());
}

}  // namespace

PointQuality::PointQuality(const PointQualityOptions& options) : options_(options) {
  if (!(options.max_depth_m > 0.0) || options.cell_px < 1) {
    throw std::invalid_argument("point quality: max_depth_m and cell_px must be positive");
  }
}

void PointQuality::add(const PointFrame& frame, const PointTruth& truth) {
  check(frame, truth);
  const PinholeCamera& camera = truth.view.camera;
  const Eigen::Isometry3d view_from_sensor = truth.view.cam_from_world() * frame.world_from_sensor;
  const int cell = options_.cell_px;
  cv::Mat hit_cells =
      cv::Mat::zeros((camera.height + cell - 1) / cell, (camera.width + cell - 1) / cell, CV_8UC1);
  ++sums_.frames;
  for (const LabeledPoint& point : frame.points) {
    ++sums_.points;
    sums_.labelled += point.label != kUnlabelled ? 1 : 0;
    const Eigen::Vector3d in_view = view_from_sensor * point.position.cast<double>();
    const cv::Point pixel = pixel_of(in_view, camera);
    if (pixel.x < 0 || is_hidden(truth.seen, pixel, in_view.z())) {
      continue;
    }
    hit_cells.at<std::uint8_t>(pixel / cell) = 1;
    compare_label(point.label, truth.labels, pixel);
    const double depth = truth.depth.empty() ? 0.0 : truth.depth.at<float>(pixel);
    if (depth > 0.0 && depth <= options_.max_depth_m) {
      compare_depth(point, in_view, depth);
    }
  }
  count_cells(truth.depth, hit_cells);
}

void PointQuality::compare_depth(const LabeledPoint& point,
                                 const Eigen::Vector3d& in_view,
                                 double truth) {
  const double error = std::abs(in_view.z() - truth);
  relative_.push_back(static_cast<float>(error / truth));
  absolute_.push_back(static_cast<float>(error));
  if (point.sigma > 0.0F) {
    sums_.sigma_m += point.sigma;
    const double along_ray = error * in_view.norm() / in_view.z();
    in_sigmas_.push_back(static_cast<float>(along_ray / point.sigma));
  }
}

void PointQuality::compare_label(Label label, const cv::Mat& labels, const cv::Point& pixel) {
  if (labels.empty() || label == kUnlabelled || labels.at<Label>(pixel) == kUnlabelled) {
    return;
  }
  ++sums_.label_points;
  sums_.label_agrees += labels.at<Label>(pixel) == label ? 1 : 0;
}

void PointQuality::count_cells(const cv::Mat& depth, const cv::Mat& hit_cells) {
  cv::Mat truth_cells = cv::Mat::zeros(hit_cells.size(), CV_8UC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float metres = depth.at<float>(y, x);
      if (metres > 0.0F && metres <= options_.max_depth_m) {
        truth_cells.at<std::uint8_t>(y / options_.cell_px, x / options_.cell_px) = 1;
      }
    }
  }
  sums_.truth_cells += static_cast<std::size_t>(cv::countNonZero(truth_cells));
  sums_.covered_cells += static_cast<std::size_t>(cv::countNonZero(truth_cells & hit_cells));
}

PointScores PointQuality::scores() const {
  PointScores scores;
  scores.frames = sums_.frames;
  scores.points = sums_.points;
  scores.points_per_frame = ratio(static_cast<double>(sums_.points), sums_.frames);
  scores.compared = relative_.size();
  scores.compared_share = ratio(static_cast<double>(scores.compared), sums_.points);
  for (const double bound : options_.relative_bounds) {
    scores.within_relative.push_back(share_within(relative_, bound));
  }
  scores.median_relative = median_or_nan(relative_);
  scores.mean_relative = mean(relative_);
  scores.median_error_m = median_or_nan(absolute_);
  scores.mean_sigma_m = ratio(sums_.sigma_m, in_sigmas_.size());
  for (std::size_t k = 0; k < scores.within_sigma.size(); ++k) {
    scores.within_sigma[k] = share_within(in_sigmas_, static_cast<double>(k + 1));
  }
  scores.sigma_factor = median_or_nan(in_sigmas_) / kGaussianMedian;
  scores.density = ratio(static_cast<double>(sums_.covered_cells), sums_.truth_cells);
  scores.labelled_share = ratio(static_cast<double>(sums_.labelled), sums_.points);
  scores.label_points = sums_.label_points;
  scores.label_agreement = ratio(static_cast<double>(sums_.label_agrees), sums_.label_points);
  return scores;
}

PointTruth own_truth(const Dataset& dataset, std::size_t index, const cv::Mat& labels) {
  const DatasetFrame& frame = dataset.frames.at(index);
  PointTruth truth{frame.view, true_depth(dataset, frame), labels, {}};
  if (!truth.depth.empty()) {
    truth.view = view_of_size(frame.view, truth.depth.size(), frame.gt_depth);
  }
  return truth;
}

std::size_t other_frame(const Dataset& dataset, std::size_t frame) {
  constexpr std::size_t kFarthest = 3;  // frames: farther away the two views share too little
  const auto has_truth = [&](std::size_t k) {
    return k < dataset.frames.size() &&
           !(dataset.frames[k].gt_depth.empty() && dataset.frames[k].scan.empty());
  };
  for (std::size_t step = 1; step <= kFarthest; ++step) {
    if (has_truth(frame + step)) {
      return frame + step;
    }
  }
  for (std::size_t step = 1; step <= std::min(kFarthest, frame); ++step) {
    if (has_truth(frame - step)) {
      return frame - step;
    }
  }
  throw std::invalid_argument("no frame near frame " + std::to_string(frame) +
                              " has ground-truth depth that its scan could be compared with");
}

PointTruth scan_truth(const Dataset& dataset,
                      std::size_t frame,
                      std::size_t other,
                      const cv::Mat& labels_of_other) {
  PointTruth truth = own_truth(dataset, other, labels_of_other);
  const DatasetFrame& scanned = dataset.frames.at(frame);
  const Eigen::Isometry3d view_from_scanner =
      truth.view.cam_from_world() * scanned.view.world_from_cam * dataset.left_from_velo;
  truth.seen = scan_depth(read_scan(scanned.scan), view_from_scanner, truth.view.camera);
  return truth;
}

}  // namespace facet_mapping
