// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scans of the synthetic street: points on roads, walls, cars and leaves, as a drive sees them.
#pragma once

#include <cstddef>
#include <vector>

#include "facet_mapping/carving/space_carver.h"

namespace facet_mapping::benchmarking {

/// `count` points with 2 cm noise, in the order of the drive, spread evenly over its scans.
/// The street is as long as they need.
std::vector<CarvingFrame> street_scans(std::size_t count);

/// The same points, each seen from its own sensor position and from the next ones of the drive:
/// `rays` rays a point.
std::vector<CarvingFrame> seen_from_neighbours(const std::vector<CarvingFrame>& frames, int rays);

}  // namespace facet_mapping::benchmarking
