// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One keyframe as refinement and labelling see it: a posed image with its segmentation.
#pragma once

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

struct LabeledView {
  View view;
  cv::Mat gray;    ///< CV_8UC1, size of the camera
  cv::Mat labels;  ///< CV_16UC1 class ids, kUnlabelled = void; empty if there is no segmentation
  double stamp = 0.0;  ///< seconds
};

}  // namespace facet_mapping
