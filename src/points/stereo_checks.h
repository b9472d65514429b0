// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contract checks of the stereo functions.
#pragma once

#include "facet_mapping/points/stereo_points.h"

namespace facet_mapping::detail {

/// Throws std::invalid_argument naming every field of `config` that is out of range.
void check_stereo_config(const StereoConfig& config);

/// Throws std::invalid_argument unless both are CV_8UC1 of one size (or both empty).
void check_stereo_pair(const cv::Mat& left, const cv::Mat& right);

/// Throws std::invalid_argument unless camera, labels and baseline fit the image.
void check_stereo_geometry(const cv::Mat& left,
                           const cv::Mat& labels,
                           const PinholeCamera& camera,
                           double baseline_m);

}  // namespace facet_mapping::detail
