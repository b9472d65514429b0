// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which cells does the evidence call free?
#pragma once

#include "carving/triangulation.h"

#include "facet_mapping/carving/space_carver.h"

namespace facet_mapping::carving {

/// Brings is_free up to date where evidence changed (is_changed, which it clears). The cut is made
/// over the changed cells and those within a few facets of them; the others keep their side.
void classify_cells(Triangulation* triangulation, const CarvingConfig& config);

}  // namespace facet_mapping::carving
