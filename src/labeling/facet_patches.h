// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Connected patches of a few dozen facets, and the facets around each. Grown over common edges, not
// cut by a grid, so that turning or scaling the mesh changes nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "labeling/class_orientation.h"
#include "labeling/facet_graph.h"

namespace facet_mapping {

struct FacetPatches {
  std::vector<std::uint32_t> patch_of;                 ///< per facet
  std::vector<FacetList> facets;                       ///< per patch
  std::vector<std::vector<std::uint32_t>> neighbours;  ///< per patch, ascending: share an edge
};

/// Every facet belongs to one patch of at most `largest` facets.
FacetPatches make_patches(const FacetGraph& graph, std::size_t largest);

/// The facets of a patch and of whole rings of patches around it until there are at least `least`,
/// or all that hang together with it.
FacetList facets_around(const FacetPatches& patches, std::uint32_t patch, std::size_t least);

}  // namespace facet_mapping
