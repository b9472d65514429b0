// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How far a mesh's rendered depth is from ground truth.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

namespace facet_mapping {

struct DepthErrorOptions {
  /// Ground truth farther away than this is not looked at, metres.
  double max_depth_m = std::numeric_limits<double>::infinity();
  /// Larger errors do not count in mean, median, RMS and bias (they count as covered), metres.
  double max_error_m = std::numeric_limits<double>::infinity();
  /// Shares are given of errors below these bounds, metres.
  std::vector<double> absolute_bounds_m{0.05, 0.1, 0.2, 0.5};
  /// Shares are given of errors below these bounds times the true depth.
  std::vector<double> relative_bounds{0.01, 0.02, 0.05};
};

/// Errors are rendered minus true planar depth, metres. Values that no pixel tells are NaN.
struct DepthScores {
  std::size_t truth_pixels = 0;    ///< pixels with ground truth
  std::size_t covered_pixels = 0;  ///< of these, pixels where the mesh is seen
  std::size_t counted_pixels = 0;  ///< of these, pixels with |error| below max_error_m
  double completeness = 0.0;       ///< covered / truth
  double mae_m = 0.0;              ///< mean |error| of the counted pixels
  double median_m = 0.0;           ///< median |error|
  double rms_m = 0.0;
  double bias_m = 0.0;                  ///< mean error, positive = mesh too far
  double trimmed_mae_m = 0.0;           ///< mean |error| without those above 10 medians
  double trimmed_rms_m = 0.0;           ///< RMS without those above 10 medians
  double trimmed_share = 0.0;           ///< counted pixels that these two leave out / counted
  std::vector<double> within_absolute;  ///< share of all truth pixels below each absolute bound
  std::vector<double> within_relative;  ///< share of all truth pixels below each relative bound
};

/// Collects pixels over any number of views.
class DepthErrors {
 public:
  explicit DepthErrors(const DepthErrorOptions& options = {}) : options_(options) {}

  /// Both CV_32FC1 of one size, metres, 0 = nothing there. Throws std::invalid_argument otherwise.
  void add(const cv::Mat& rendered, const cv::Mat& truth);

  /// Adds all pixels of another collection with the same options.
  void add(const DepthErrors& other);

  DepthScores scores() const;

 private:
  void add_pixel(float rendered, float truth);

  DepthErrorOptions options_;
  std::size_t truth_pixels_ = 0;
  std::size_t covered_pixels_ = 0;
  std::vector<float> errors_;  // counted pixels, signed
  std::vector<std::size_t> within_absolute_ =
      std::vector<std::size_t>(options_.absolute_bounds_m.size());
  std::vector<std::size_t> within_relative_ =
      std::vector<std::size_t>(options_.relative_bounds.size());
};

}  // namespace facet_mapping
