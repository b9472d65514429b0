// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contracts of the feature tracker.
#pragma once

#include "facet_mapping/points/track_points.h"

namespace facet_mapping::detail {

/// Both throw std::invalid_argument that names everything that is wrong.
void check_track_config(const TrackConfig& config);
void check_track_image(const cv::Mat& gray, const PinholeCamera& camera, const cv::Mat& labels);

}  // namespace facet_mapping::detail
