// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How good a source's points are: against ground-truth depth, and against what they say themselves.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/io/dataset.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

struct PointQualityOptions {
  /// Ground truth farther away than this is not looked at, metres.
  double max_depth_m = std::numeric_limits<double>::infinity();
  /// Shares are given of points whose depth error is at most these parts of the true depth.
  std::vector<double> relative_bounds{0.01, 0.03, 0.05};
  int cell_px = 16;  ///< side of the square cells that the density over the image is counted in
};

/// What one frame's points are compared with, in one view.
struct PointTruth {
  View view;
  cv::Mat depth;   ///< CV_32FC1 of the view's size, planar depth in metres, 0 = none; empty: none
  cv::Mat labels;  ///< CV_16UC1 of the view's size; empty: no classes
  /// CV_32FC1 of the view's size: depth of what the sensor itself knows to be in front, 0 = nothing
  /// known. Points elsewhere than there are hidden from the view. Empty: the view sees all points.
  cv::Mat seen;
};

/// Relative errors are |depth - truth| / truth. Values that no point tells are NaN.
struct PointScores {
  std::size_t frames = 0;
  std::size_t points = 0;
  double points_per_frame = 0.0;
  std::size_t compared = 0;  ///< points in the view, not hidden, with ground truth at their pixel
  double compared_share = 0.0;          ///< of all points
  std::vector<double> within_relative;  ///< share of compared points within each bound
  double median_relative = 0.0;
  double mean_relative = 0.0;
  double median_error_m = 0.0;           ///< median |error| along the view's axis, metres
  double mean_sigma_m = 0.0;             ///< of compared points that state one
  std::array<double, 3> within_sigma{};  ///< share of those within 1, 2, 3 of their sigma, along
                                         ///< the ray (Gaussian noise: 0.683, 0.954, 0.997)
  double sigma_factor = 0.0;  ///< median |error| / sigma over that of Gaussian noise: 1 = sigma is
                              ///< right, 2 = errors are twice what it says
  double density = 0.0;  ///< share of cells with ground truth in which a point of the frame lies
  double labelled_share = 0.0;   ///< points with a class, of all points
  std::size_t label_points = 0;  ///< points with a class in the view where its labels have one, too
  double label_agreement = 0.0;  ///< of those, the share with the same class
};

/// Collects frames of one source.
class PointQuality {
 public:
  /// Throws std::invalid_argument on options out of range.
  explicit PointQuality(const PointQualityOptions& options = {});

  /// A point is compared with the one pixel that it falls on: sparse ground truth is not enlarged,
  /// as that would mix both sides of depth edges. Throws std::invalid_argument if an image is of
  /// another type or size than the view's.
  void add(const PointFrame& frame, const PointTruth& truth);

  PointScores scores() const;

 private:
  struct Sums {
    std::size_t frames = 0;
    std::size_t points = 0;
    std::size_t labelled = 0;
    std::size_t label_points = 0;
    std::size_t label_agrees = 0;
    std::size_t truth_cells = 0;
    std::size_t covered_cells = 0;
    double sigma_m = 0.0;
  };

  void compare_depth(const LabeledPoint& point, const Eigen::Vector3d& in_view, double truth);
  void compare_label(Label label, const cv::Mat& labels, const cv::Point& pixel);
  void count_cells(const cv::Mat& depth, const cv::Mat& hit_cells);

  PointQualityOptions options_;
  Sums sums_;
  std::vector<float> relative_;   // one per compared point
  std::vector<float> absolute_;   // the same, metres
  std::vector<float> in_sigmas_;  // one per compared point with a sigma
};

/// The ground truth of the frame's own view: its depth image, or its scan where there is none.
/// `labels`: what classes are compared with, see PointTruth. Throws std::runtime_error on broken
/// files.
PointTruth own_truth(const Dataset& dataset, std::size_t frame, const cv::Mat& labels);

/// A frame near `frame` (the next one if there is, else the one before) that has ground-truth depth
/// of its own. Throws std::invalid_argument if there is none: then a scan can only be compared with
/// itself.
std::size_t other_frame(const Dataset& dataset, std::size_t frame);

/// What a frame's LiDAR scan is compared with where the ground truth is LiDAR, too: the ground
/// truth of another frame, carried over by the poses. `seen` is the whole scan in that view,
/// without what it hides itself. Throws std::runtime_error on broken files.
PointTruth scan_truth(const Dataset& dataset,
                      std::size_t frame,
                      std::size_t other,
                      const cv::Mat& labels_of_other);

}  // namespace facet_mapping
