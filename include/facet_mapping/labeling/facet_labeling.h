// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The Markov random field over facets (Romanoni et al. 2017, Sec. 3.1).
#pragma once

#include <cstddef>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/labeled_view.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

struct LabelingConfig {
  double beta = 0.1;              ///< floor of the data probability
  double normal_weight = 1.5;     ///< exponent lambda_n of the orientation prior
  double smooth_equal = 0.8;      ///< pairwise probability of equal labels
  double smooth_different = 0.2;  ///< pairwise probability of different labels
  double depth_tolerance = 0.02;  ///< relative depth slack of the visibility test
  int max_sweeps = 10;            ///< alpha-expansion sweeps over all classes
};

struct LabelingResult {
  std::vector<Label> labels;         ///< per facet; kUnlabelled where no evidence reaches
  std::vector<float> confidence;     ///< per facet, 0..1
  std::vector<std::uint16_t> views;  ///< per facet: images that see one of its vertices
  double energy_before = 0.0;        ///< of the arg-max data labelling
  double energy_after = 0.0;
  std::size_t changed = 0;  ///< facets whose label differs from the mesh's
};

/// `renderings[k]` is the mesh rendered in `views[k]`. Views without a segmentation are ignored.
/// Throws std::invalid_argument on sizes that do not match.
LabelingResult label_facets(const TriangleMesh& mesh,
                            const std::vector<LabeledView>& views,
                            const std::vector<FacetImage>& renderings,
                            const LabelingConfig& config);

}  // namespace facet_mapping
