// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The neighbourhood f1 ~ f2 of the random field: facets that share an edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labeling/alpha_expansion.h"
#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

struct FacetGraph {
  std::vector<PottsEdge> edges;
  std::vector<std::array<std::int32_t, 3>> edges_of;  ///< per facet and side: its edge or -1

  /// The facet at the other end of an edge.
  std::uint32_t other(std::int32_t edge, std::uint32_t facet) const {
    const PottsEdge& e = edges[static_cast<std::size_t>(edge)];
    return e.a == facet ? e.b : e.a;
  }
};

/// Potts weights log(smooth_equal / smooth_different) times the length of the common edge over the
/// mean edge length of the two facets. Not over the mean of the whole mesh: edges of a Delaunay
/// mesh differ a hundredfold, so that large facets would be deaf to what the images say about them.
FacetGraph make_facet_graph(const TriangleMesh& mesh, const LabelingConfig& config);

/// Rings of facets around those with a class, nearest first: every facet that a class reaches takes
/// the class of the neighbour that it was reached from; the others stay kNoClass.
void spread_classes(const FacetGraph& graph, std::vector<ClassIndex>* classes);

}  // namespace facet_mapping
