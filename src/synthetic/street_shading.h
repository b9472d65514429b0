// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Light: Lambert under sun and sky, haze, and the camera's response.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "facet_mapping/synthetic/street_view.h"

namespace facet_mapping {

/// Linear colour (R G B) of the sky in a direction of the map.
Eigen::Vector3f sky_color(const Eigen::Vector3f& direction);

/// Light on a surface: `sun_cosine` and `sunlit` in [0, 1].
Eigen::Vector3f irradiance(const Eigen::Vector3f& normal, float sun_cosine, float sunlit);

/// CV_8UC3 (BGR) of a linear CV_32FC3 (R G B), with exposure and noise.
cv::Mat develop(const cv::Mat& linear, const SensorNoise& noise);

}  // namespace facet_mapping
