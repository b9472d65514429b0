// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Do the depths of other images agree with those of a reference?
#pragma once

#include <vector>

#include "sweep_image.h"
#include <opencv2/core.hpp>

namespace facet_mapping::detail {

/// What the motion between a reference and its neighbours says about the inverse depth of each
/// pixel, CV_32F, pixels as swept per 1/m: root of the sum of squares over the views that see it,
/// which are worth no more than two of their mean.
cv::Mat depth_precision(const SweepImage& reference, const std::vector<const SweepImage*>& others);

/// CV_8UC1, 255 where at least `min_agreeing` of the others' depths are the reference's to within
/// `max_px` / precision, and more than see through it.
cv::Mat find_agreeing(const SweepImage& reference,
                      const std::vector<const SweepImage*>& others,
                      const cv::Mat& precision,
                      double max_px,
                      int min_agreeing);

}  // namespace facet_mapping::detail
