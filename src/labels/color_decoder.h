// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Colour-coded label images; part of decode_label_image.
#pragma once

#include <opencv2/core.hpp>

#include "facet_mapping/labels/label_image.h"

namespace facet_mapping::detail {

/// Turns a CV_8UC3 image of class colours into CV_16UC1 ids and says in `report` what did not fit.
cv::Mat decode_colors(const cv::Mat& image,
                      bool red_first,
                      const LabelSet& labels,
                      LabelImageReport& report);

}  // namespace facet_mapping::detail
