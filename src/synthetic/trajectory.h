// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The drive along the street.
#pragma once

#include <vector>

#include "centerline.h"

namespace facet_mapping {

/// The first pose is the map's origin exactly; sway, pitch and roll grow within a few metres.
std::vector<StreetPose> drive(const StreetConfig& config, const Centerline& line);

/// Number of frames that fit the street.
int fitting_frames(const StreetConfig& config);

}  // namespace facet_mapping
