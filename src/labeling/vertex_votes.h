// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the segmentations say about each vertex: the counts behind nu(v, l) of the paper.
#pragma once

#include <cstdint>
#include <vector>

#include "facet_mapping/labeling/alpha_expansion.h"
#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

constexpr ClassIndex kNoClass = 65535;

/// The classes that are tried, and the votes for them.
struct VertexVotes {
  std::vector<Label> classes;              ///< in the order of their evidence, strongest first
  std::vector<std::uint16_t> counts;       ///< vertices rows of one count per class
  std::vector<std::uint16_t> seen;         ///< per vertex: images that see it with a class
  std::vector<std::uint16_t> facet_views;  ///< per facet: images that see one of its vertices

  /// Share of the images seeing `vertex` that say class `index`; 0 if none sees it.
  double share(std::size_t vertex, std::size_t index) const {
    return seen[vertex] == 0
               ? 0.0
               : static_cast<double>(counts[vertex * classes.size() + index]) / seen[vertex];
  }
  /// Index of a label among the classes, kNoClass if it is not tried.
  ClassIndex index_of(Label label) const;
};

/// Classes are those that some vertex is seen with or some facet of the mesh has, without excluded.
VertexVotes count_votes(const TriangleMesh& mesh,
                        const std::vector<LabeledView>& views,
                        const std::vector<FacetImage>& renderings,
                        const LabelingConfig& config);

}  // namespace facet_mapping
