// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which cells does the evidence call free?
#pragma once

#include <vector>

#include "carving/triangulation.h"

#include "facet_mapping/carving/space_carver.h"

namespace facet_mapping::carving {

/// Sets is_free and order of every cell; returns the free cells, most evidence first.
std::vector<CellHandle> classify_cells(Triangulation* triangulation, const CarvingConfig& config);

}  // namespace facet_mapping::carving
