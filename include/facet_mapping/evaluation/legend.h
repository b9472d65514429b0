// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the colours of a picture mean, in rows below it.
#pragma once

#include <string>

#include <opencv2/core.hpp>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {

/// `picture` with swatches and names of the classes in `classes` (CV_16UC1) below it.
cv::Mat with_class_legend(const cv::Mat& picture, const cv::Mat& classes, const LabelSet& labels);

/// `picture` with the colour scale of error_picture or (`reversed`) depth_picture below it.
cv::Mat with_scale_legend(const cv::Mat& picture,
                          const std::string& left_text,
                          const std::string& right_text,
                          bool reversed);

}  // namespace facet_mapping
