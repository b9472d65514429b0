// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The depths of one image from its neighbours.
#pragma once

#include "sweep_directions.h"
#include "sweep_image.h"

#include "facet_mapping/points/sweep_points.h"

namespace facet_mapping::detail {

/// Sweeps the reference on planes that face it and along the scene's directions, which it adds to,
/// and sets its inverse depths.
void sweep_image(const SweepNeighbours& neighbours,
                 const SweepConfig& config,
                 SceneDirections* directions,
                 SweepImage* reference,
                 SweepReport* report);

}  // namespace facet_mapping::detail
