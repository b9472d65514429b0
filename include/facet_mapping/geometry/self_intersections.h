// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does the surface run through itself?
#pragma once

#include <cstddef>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// Number of pairs of facets that have more in common than the corners and edges that they share.
/// Decided exactly, in about n log n time (CGAL). Facets without area are left out, and so are
/// pairs that meet where the mesh is no oriented 2-manifold. Throws std::invalid_argument if the
/// mesh is invalid.
std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace facet_mapping
