// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of refine().
#pragma once

#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/labeled_view.h"
#include "facet_mapping/refinement/refiner.h"

namespace facet_mapping {

/// Each throws std::invalid_argument with a sentence that names the offending value.
void check_config(const RefinementConfig& config);
void check_views(const std::vector<LabeledView>& views);
void check_mesh(const TriangleMesh& mesh, const MeshPart& part);
void check_part_views(std::size_t seeing, std::size_t views);

}  // namespace facet_mapping
