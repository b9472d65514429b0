// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Viewing rays toward the sky: nothing was met along them, so they carve.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

struct SkyConfig {
  int cell_px = 16;       ///< one ray per square of this size that is sky all over; 0 = none
  double range_m = 60.0;  ///< where the rays end, metres from the camera
};

/// One point per ray, in the camera's optical frame, metres, with its pixel's class and sigma 0.
/// `labels`: CV_16UC1 ids, size of the camera's image; empty: no points. `sky`: ids of sky classes.
/// Throws std::invalid_argument on labels of another type or size, or a config out of range.
std::vector<LabeledPoint> sky_points(const cv::Mat& labels,
                                     const PinholeCamera& camera,
                                     const std::vector<Label>& sky,
                                     const SkyConfig& config);

}  // namespace facet_mapping
