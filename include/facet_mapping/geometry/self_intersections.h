// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does the surface run through itself?
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

using FacetPair = std::pair<std::uint32_t, std::uint32_t>;  ///< ascending

/// The pairs of facets that have more in common than the corners and edges that they share, sorted.
/// Decided exactly (CGAL), in about n log n time. Facets without area are left out. If `changed`
/// has an entry per facet, only pairs with at least one facet where it is not zero are looked for.
/// Throws std::invalid_argument if the mesh is invalid or `changed` is neither empty nor of one
/// entry per facet.
std::vector<FacetPair> find_self_intersections(const TriangleMesh& mesh,
                                               const std::vector<std::uint8_t>& changed = {});

/// Those of the pairs, in their order, that cross in `mesh`.
std::vector<FacetPair> keep_crossing(const TriangleMesh& mesh, const std::vector<FacetPair>& pairs);

/// The number of pairs that find_self_intersections returns.
std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace facet_mapping
