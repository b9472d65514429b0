// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/facet_patches.h"

#include <algorithm>
#include <limits>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kNoPatch = std::numeric_limits<std::uint32_t>::max();

/// Rings of facets without patch around `seed`, nearest first.
FacetList grow(const FacetGraph& graph,
               std::uint32_t seed,
               std::uint32_t patch,
               std::size_t largest,
               std::vector<std::uint32_t>* patch_of) {
  FacetList facets{seed};
  (*patch_of)[seed] = patch;
  for (std::size_t next = 0; next < facets.size(); ++next) {
    for (const std::int32_t edge : graph.edges_of[facets[next]]) {
      if (edge < 0 || facets.size() >= largest) {
        continue;
      }
      const std::uint32_t other = graph.other(edge, facets[next]);
      if ((*patch_of)[other] == kNoPatch) {
        (*patch_of)[other] = patch;
        facets.push_back(other);
      }
    }
  }
  return facets;
}

}  // namespace

FacetPatches make_patches(const FacetGraph& graph, std::size_t largest) {
  FacetPatches patches;
  patches.patch_of.assign(graph.edges_of.size(), kNoPatch);
  for (std::uint32_t f = 0; f < graph.edges_of.size(); ++f) {
    if (patches.patch_of[f] == kNoPatch) {
      const auto patch = static_cast<std::uint32_t>(patches.facets.size());
      patches.facets.push_back(grow(graph, f, patch, largest, &patches.patch_of));
    }
  }
  patches.neighbours.resize(patches.facets.size());
  for (const PottsEdge& edge : graph.edges) {
    const std::uint32_t a = patches.patch_of[edge.a];
    const std::uint32_t b = patches.patch_of[edge.b];
    if (a != b) {
      patches.neighbours[a].push_back(b);
      patches.neighbours[b].push_back(a);
    }
  }
  for (std::vector<std::uint32_t>& others : patches.neighbours) {
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
  }
  return patches;
}

FacetList facets_around(const FacetPatches& patches, std::uint32_t patch, std::size_t least) {
  FacetList facets = patches.facets[patch];
  std::vector<std::uint32_t> reached{patch};  // few, so that a search beats marks for all patches
  std::size_t ring = 0;
  while (facets.size() < least && ring < reached.size()) {
    for (const std::size_t end = reached.size(); ring < end; ++ring) {
      for (const std::uint32_t other : patches.neighbours[reached[ring]]) {
        if (std::find(reached.begin(), reached.end(), other) == reached.end()) {
          reached.push_back(other);
          facets.insert(facets.end(), patches.facets[other].begin(), patches.facets[other].end());
        }
      }
    }
  }
  return facets;
}

}  // namespace facet_mapping
