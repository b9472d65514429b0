// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of the standard car, shared by its geometry and its texture. Frame: x forward, y left,
// z up, on the ground under the middle; metres. Cars are this one, stretched.
#pragma once

namespace facet_mapping::standard_car {

constexpr float kHalfLength = 2.10F;
constexpr float kHalfWidth = 0.88F;
constexpr float kBelt = 0.93F;  ///< lower edge of the side windows
constexpr float kWheelRadius = 0.31F;
constexpr float kWheelWidth = 0.20F;
constexpr float kFrontAxle = 1.28F;
constexpr float kRearAxle = -1.26F;

/// Height of the silhouette seen from the side.
float top_height(float x);
/// Height of the lower edge.
float bottom_height(float x);
/// Half width seen from above, at the height of the doors.
float half_width(float x);

}  // namespace facet_mapping::standard_car
