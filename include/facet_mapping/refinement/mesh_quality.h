// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Well-shaped facets without another shape: short edges collapse, others are flipped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// Local lengths: the mean length of the edges around a vertex and around its neighbours.
struct QualityOptions {
  double short_edge = 0.2;  ///< edges shorter than this collapse, in local lengths
  double needle_deg = 8.0;  ///< so do the shortest edges of facets with a smaller angle
  double max_drift = 0.05;  ///< the surface moves by at most this, in local lengths
  double turn_cos = 0.9;    ///< a collapse turns no facet by more
  double flat_cos = 0.97;   ///< edges between facets that differ by more are not flipped
  double flip_deg = 25.0;   ///< nor those of facets whose angles are all larger
  double flip_gain = 1.1;   ///< a flip raises the sine of the smaller angle by this factor
};

struct QualityReport {
  std::size_t collapses = 0;
  std::size_t flips = 0;
};

/// Collapses short edges and the short sides of needles into one of their ends (Hoppe et al. 1993,
/// with the link condition of Dey et al. 1999) and flips edges between nearly coplanar facets where
/// this makes their smallest angle larger. Each such step makes the smallest angle of the facets
/// around it larger. Vertices only vanish, none moves. A closed 2-manifold stays one of the same
/// genus; open borders and non-manifold places stay as they are, and so does, up to `max_drift`,
/// the border between classes and between seen surface and gaps. No pair of facets crosses
/// afterwards that did not before. Facets that survive keep their attributes. Facets with `may_change` zero are left alone (none given: all may change). Takes
/// about linear time. Throws std::invalid_argument if the mesh is invalid or `may_change` is not
/// empty and has not one entry per facet.
TriangleMesh improve_quality(const TriangleMesh& mesh,
                             const QualityOptions& options = {},
                             QualityReport* report = nullptr,
                             const std::vector<std::uint8_t>& may_change = {});

}  // namespace facet_mapping
