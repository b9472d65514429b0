// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which images a reference is compared with.
#pragma once

#include <deque>

#include "sweep_image.h"

#include "facet_mapping/points/sweep_points.h"

namespace facet_mapping::detail {

/// True if the second view is so far from the first that points at `depth_m` have parallax.
bool has_moved(const View& from, const View& to, double depth_m, const SweepConfig& config);

/// Those of the images at most `window` places from `index` that show enough of what the
/// reference shows at `depth_m`, from another place but not from another side.
SweepNeighbours find_neighbours(const std::deque<SweepImage>& images,
                                std::size_t index,
                                double depth_m,
                                const SweepConfig& config);

}  // namespace facet_mapping::detail
