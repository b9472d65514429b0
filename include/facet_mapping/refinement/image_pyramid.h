// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coarse copies of the views for the coarse-to-fine scheme.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/label.h"
#include "facet_mapping/labels/labeled_view.h"

namespace facet_mapping {

/// The view with images of a size divided by 2^level (rounded): intensities are averaged over the
/// covered area, classes are decided by majority; the camera keeps the same pixel areas.
LabeledView shrink_view(const LabeledView& view, int level);

/// CV_16UC1 class image resampled by majority vote, ties going to the lower id: classes are never
/// mixed and, unlike nearest-neighbour sampling, the picture does not shift by half a pixel.
cv::Mat shrink_labels(const cv::Mat& labels, const cv::Size& size);

}  // namespace facet_mapping
