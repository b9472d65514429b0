// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Labelled points from a rectified stereo pair (OpenCV semi-global matching).
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

struct StereoConfig {
  int num_disparities = 128;             ///< search range in pixels, a multiple of 16
  int block_size = 5;                    ///< matching window in pixels, odd, at most 11
  int uniqueness_percent = 10;           ///< margin of the best over the second-best cost
  double left_right_tolerance_px = 1.5;  ///< largest disagreement of the two directions
  int speckle_size_px = 200;             ///< smaller regions of similar disparity are dropped
  double edge_jump_px = 1.5;        ///< disparities of neighbours that differ more are a depth edge
  int edge_margin_px = 2;           ///< pixels so near to a depth edge or a hole are dropped
  double disparity_sigma_px = 0.5;  ///< noise of a typical match, that sigma comes from
  double max_relative_sigma = 0.05;  ///< points with sigma / depth above this are dropped
  double min_depth_m = 1.0;          ///< nearer points are dropped
  double max_depth_m = 60.0;         ///< farther points are dropped
  int cell_px = 5;                   ///< at most one point per cell of this size ...
  double min_gradient =
      4.0;  ///< ... the pixel of strongest gradient, if above this (8-bit units per pixel)
  int flat_cell_px = 12;               ///< cell size where no pixel reaches min_gradient
  std::vector<Label> excluded_labels;  ///< pixels of these classes (sky) give no points
};

struct StereoReport {
  std::size_t matched_pixels = 0;  ///< pixels with a disparity
  std::size_t points = 0;          ///< points returned
};

/// Disparity (CV_32F, pixels, NaN where none) of a rectified 8-bit grey pair: semi-global matching
/// (Hirschmueller 2008; OpenCV's three-path form), checked against a match in the other direction
/// at half size. The near half of the search range is matched at half size, so that disparities
/// there are only good to half a pixel; stereo_points() refines them. Pairs smaller than the window
/// give NaN.
/// Throws std::invalid_argument on unequal sizes, other types or a config out of range.
cv::Mat stereo_disparity(const cv::Mat& left, const cv::Mat& right, const StereoConfig& config);

/// Thinned points in the left camera's optical frame, metres, each disparity refined on the images.
/// `labels` (CV_16UC1 ids, size of the image) may be empty: then no point has a class. Pixels near
/// depth edges, out of range or of an excluded class give no point; an empty pair gives none.
/// sigma = depth^2 * disparity_sigma_px * doubt / (fx * baseline_m); the doubt of a match (0.8 or
/// more) grows with its residual, with missing texture and near other surfaces.
/// Throws std::invalid_argument as stereo_disparity does, and if camera, labels or baseline do not
/// fit the images.
std::vector<LabeledPoint> stereo_points(const cv::Mat& left,
                                        const cv::Mat& right,
                                        const cv::Mat& labels,
                                        const PinholeCamera& camera,
                                        double baseline_m,
                                        const StereoConfig& config,
                                        StereoReport* report = nullptr);

}  // namespace facet_mapping
