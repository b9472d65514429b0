// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the energies' first and second order to a displacement of the vertices.
#pragma once

#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/smoothing.h"
#include "facet_mapping/refinement/vertex_field.h"

namespace facet_mapping {

/// The displacement d that minimises the model
///   g . d + 1/2 d . H d + smoothing(x + d),
/// H the diagonal curvature of `data`, by conjugate gradients. Vertices about which neither images
/// nor smoothing weights say anything (`movable` 0) stay. Solving, rather than averaging neighbours
/// once per iteration, carries what well-textured vertices know to poor ones around them.
VectorField solve_step(const TriangleMesh& mesh,
                       const VertexField& data,
                       const SmoothingTerm& smoothing,
                       const std::vector<std::uint8_t>& movable);

/// Shortens each displacement to `fraction` of the mean length of the edges at its vertex.
void limit_step(const TriangleMesh& mesh,
                const Adjacency& neighbours,
                double fraction,
                VectorField* step);

/// Shortens displacements until no facet turns by more than about 78 degrees (its new normal keeps
/// a cosine of 0.2 with the old one); facets without area are not looked at. Returns the number of
/// vertices that were held back.
std::size_t prevent_flips(const TriangleMesh& mesh, VectorField* step);

}  // namespace facet_mapping
