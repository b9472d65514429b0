// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that do not push the surface through itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/geometry/self_intersections.h"
#include "facet_mapping/refinement/smoothing.h"

namespace facet_mapping {

/// Shortens displacements, where needed to nothing, until no pair of facets crosses that does not
/// cross in `mesh`: `crossing` are the pairs that do. Facets turn by no more than prevent_flips
/// allows. Returns the number of vertices that were held back.
std::size_t prevent_crossings(const TriangleMesh& mesh,
                              const std::vector<FacetPair>& crossing,
                              VectorField* step);

/// subdivide() with facets that cross others left whole, and as many rings around them as it takes
/// for their pieces not to cross more often than they did, up to four.
TriangleMesh subdivide_beside_crossings(const TriangleMesh& mesh,
                                        std::vector<double> pixels,
                                        double limit);

}  // namespace facet_mapping
