// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a forest sees of each cell of an image.
#pragma once

#include <opencv2/core.hpp>

#include "facet_mapping/segmentation/forest_model.h"
#include "facet_mapping/segmentation/segmenter.h"

namespace facet_mapping::detail {

/// The meaning of the features; a file of another version cannot be used.
constexpr int kFeatureVersion = 1;

/// Cells along and across an image.
cv::Size cell_grid(const cv::Size& image, const CellConfig& config);

int feature_count(const CellConfig& config);

/// CV_32FC1, one row per cell (row by row), one column per feature. Throws std::invalid_argument
/// if the view is needed and not given.
cv::Mat cell_features(const cv::Mat& bgr, const GroundView* ground, const CellConfig& config);

/// Throws std::invalid_argument on settings that are out of range.
void check_cells(const CellConfig& config);

}  // namespace facet_mapping::detail
