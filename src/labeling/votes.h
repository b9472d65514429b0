// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the segmentations say about each vertex (the counts behind nu(v, l) of the paper) and about
// the pixels that show each facet.
#pragma once

#include <cstdint>
#include <vector>

#include "facet_mapping/labeling/alpha_expansion.h"
#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

constexpr ClassIndex kNoClass = 65535;
constexpr std::int32_t kNotObserved = -1;

/// As many pixels as the three vertices' votes are worth: they decide on facets smaller than that.
constexpr double kVertexPixels = 5.0;

/// The classes that are tried, and the votes for them.
struct Votes {
  std::vector<Label> classes;               ///< in the order of their evidence, strongest first
  std::vector<std::uint16_t> vertex;        ///< vertices rows of one count of images per class
  std::vector<std::uint16_t> vertex_views;  ///< per vertex: images that see it, void left out
  std::vector<std::uint32_t> pixel;         ///< facets rows of one count of pixels per class
  std::vector<std::uint32_t> pixels;        ///< per facet: pixels that show it, void left out
  std::vector<std::uint16_t> facet_views;   ///< per facet: images that see a vertex or pixel of it

  /// nu(v, l): share of the images seeing vertex `v` that say class `index`; 0 if none sees it.
  double vertex_share(std::size_t v, std::size_t index) const {
    return vertex_views[v] == 0
               ? 0.0
               : static_cast<double>(vertex[v * classes.size() + index]) / vertex_views[v];
  }
  /// The evidence for class `index` at a facet, 0..1: the mean share of its vertices, counted as
  /// kVertexPixels pixels, together with the pixels that show it.
  double share(std::size_t facet, const Triangle& corners, std::size_t index) const;
  /// Of all classes; all zero where no image supports any.
  std::vector<double> shares(std::size_t facet, const Triangle& corners) const;

  /// Index of a label among the classes, kNoClass if it is not tried.
  ClassIndex index_of(Label label) const;
};

/// Classes are those that some vertex or pixel is seen with or some facet of the mesh has, without
/// the excluded ones. Without config.pixel_votes no pixel is counted. `facet_of`: for each facet id
/// of the renderings the facet of `mesh`, or kNotObserved.
Votes count_votes(const TriangleMesh& mesh,
                  const std::vector<LabeledView>& views,
                  const std::vector<FacetImage>& renderings,
                  const std::vector<std::int32_t>& facet_of,
                  const LabelingConfig& config);

}  // namespace facet_mapping
