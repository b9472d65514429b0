// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Semi-global smoothing of the costs of parallel planes.
#pragma once

#include <opencv2/core.hpp>

namespace facet_mapping::detail {

/// Sums over four paths of semi-global matching (Hirschmueller 2008) of costs as sweep_costs()
/// gives them: CV_16SC1 of the same shape. Changes of plane cost less where `gray` (CV_8UC1) has an
/// edge.
cv::Mat smooth_costs(const cv::Mat& costs, const cv::Mat& gray);

}  // namespace facet_mapping::detail
