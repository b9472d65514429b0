// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a swept image.
#pragma once

#include <vector>

#include "sweep_image.h"

#include "facet_mapping/points/sweep_points.h"

namespace facet_mapping::detail {

/// `compared`: the images that the reference was swept with; `checked`: swept ones near it.
std::vector<LabeledPoint> swept_points(const SweepImage& reference,
                                       const std::vector<const SweepImage*>& compared,
                                       const std::vector<const SweepImage*>& checked,
                                       const SweepConfig& config,
                                       SweepReport* report);

}  // namespace facet_mapping::detail
