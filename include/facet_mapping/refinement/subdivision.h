// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finer facets where the images show more than the mesh (Romanoni et al. 2017, Sec. 3.2).
#pragma once

#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/surface_view.h"

namespace facet_mapping {

/// Per facet, the number of pixels that it covers in the view where it covers most.
std::vector<double> best_view_pixels(const TriangleMesh& mesh,
                                     const std::vector<SurfaceView>& surfaces);

/// Splits facets until none covers more than `limit` pixels (children take their share of the
/// parent's pixels by area). Edges are split, not facets: both facets of a split edge use the same
/// new vertex, so a closed 2-manifold stays one and no T-junction arises. Wherever an edge is split
/// the longest edge of its facets is split too, which keeps the angles from degenerating.
/// Attributes are carried to the children; `parents`, if given, gets each child's facet of `mesh`.
/// Throws std::invalid_argument if `pixels` has not one entry per facet or `limit` is not positive.
TriangleMesh subdivide(const TriangleMesh& mesh,
                       const std::vector<double>& pixels,
                       double limit,
                       std::vector<std::uint32_t>* parents = nullptr);

}  // namespace facet_mapping
