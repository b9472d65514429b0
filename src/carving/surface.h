// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The boundary of the manifold free space as a labelled mesh.
#pragma once

#include "carving/triangulation.h"

#include "facet_mapping/carving/space_carver.h"

namespace facet_mapping::carving {

/// Facets run counter-clockwise seen from free space. A facet takes the class of the matter cell
/// behind it or, where no ray labelled that cell, of the points at its corners. A facet that only
/// closes the surface (an edge longer than `max_edge_m`, or an extra vertex) is a gap: no class, no
/// views.
CarvedSurface make_surface(const Triangulation& triangulation, double max_edge_m);

/// Drops connected parts of fewer than `min_facets` facets: specks of matter round an isolated
/// point, bubbles of free space inside matter. What is left is as closed and manifold as before.
CarvedSurface without_small_parts(CarvedSurface surface, std::size_t min_facets);

}  // namespace facet_mapping::carving
