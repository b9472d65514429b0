// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas and confidence of a labelled mesh for the ~stats topic.
#pragma once

#include <facet_mapping/MeshStats.h>

#include "facet_mapping/mapping/mesh_totals.h"

namespace facet_mapping {

/// Fills facets, vertices, area, mean_confidence, class_ids and class_areas.
void fill_mesh_stats(const MeshTotals& totals, MeshStats* stats);

}  // namespace facet_mapping
