// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Markov random field over facets (Romanoni et al. 2017, Sec. 3.1): the energy
//   sum_f [-log P_data(l, f) - normal_weight * log P_norm(l, f)] + sum_(f~g) w_fg [l_f != l_g]
// is minimised by alpha-expansion. P_data is max(beta, mean over the three vertices of the share of
// the images seeing the vertex that say l); with `pixel_votes` the pixels that show the facet vote
// too. P_norm falls with the angle to the class's mean normal (see
// OrientationPrior for other forms). w_fg = log(smooth_equal /
// smooth_different) * (length of the common edge / mean edge length of f and g).
//
// Why pixels: points are taken where the image has structure, so the vertices of a mapped mesh
// stand on class borders, where segmentations and projections are least certain, and few large
// facets may fill much of an image.
//
// Where no image sees a facet there is no data term, only the orientation prior, the neighbours and
// a mild preference for the mesh's own label. Parts of the mesh that neither an image nor a label
// of their own reaches over any chain of neighbours stay unlabelled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/labeled_view.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

/// What the orientation of a class's facets is learned from. Without any: normal_weight 0.
enum class OrientationPrior {
  kGlobal,   ///< one mean direction per class (Romanoni et al. 2017)
  kMixture,  ///< several directions per class, as many as the mesh asks for: walls look many ways
  kLocal     ///< one per class and neighbourhood (after Romanoni and Matteucci 2018): roads climb
};

struct LabelingConfig {
  double beta = 0.1;        ///< floor of the data probability
  bool pixel_votes = true;  ///< evidence from all pixels of a facet; off: its vertices (the paper)
  OrientationPrior orientation_prior = OrientationPrior::kGlobal;
  double normal_weight = 1.5;  ///< exponent lambda_n of the orientation prior
  double normal_floor = 0.2;   ///< of the orientation probability: no prior outvotes all images
  double min_normal_sigma_deg = 10.0;  ///< least angular deviation that a class is credited with
  int min_normal_facets = 20;          ///< classes with fewer facets have no orientation prior
  int local_facets = 4000;             ///< size of a neighbourhood of OrientationPrior::kLocal
  double smooth_equal = 0.8;           ///< pairwise probability of equal labels
  double smooth_different = 0.2;       ///< pairwise probability of different labels
  double own_label_weight =
      0.7;  ///< cost (nats) of dropping the mesh's own label where no image sees
  double depth_tolerance = 0.02;  ///< relative depth slack of the visibility test
  int max_sweeps = 10;            ///< alpha-expansion sweeps over all classes
  std::vector<Label> excluded;    ///< never given to a facet, see LabelSet::sky_ids
};

struct LabelingResult {
  std::vector<Label> labels;  ///< per facet; kUnlabelled where no evidence reaches
  /// Per facet, 0..1: the local posterior of its label minus that of the next best class, given the
  /// final labels of those neighbours that have evidence of their own (min-marginals of the whole
  /// field would be too dear). Facets deep in unseen parts thus have confidence 0.
  std::vector<float> confidence;
  std::vector<std::uint16_t> views;  ///< per facet: images that see one of its vertices or pixels
  double energy_before = 0.0;        ///< nats, of the arg-max data labelling
  double energy_after = 0.0;         ///< nats, never above energy_before
  std::size_t changed = 0;           ///< facets whose label differs from the mesh's
};

/// `renderings[k]` is the mesh rendered in `views[k]`. Views without a segmentation are ignored.
/// Gaps of the mesh (see is_gap) stay unlabelled; render the views without them (ObservedMesh).
/// Void pixels (kUnlabelled) do not count as seeing; pixels of excluded labels do, but support no
/// class: what is seen against the sky most of the time is no evidence for the rest. The result
/// does not depend on the number of threads nor on how the classes are numbered.
/// Throws std::invalid_argument on sizes or types that do not match, an invalid mesh or camera, or
/// a configuration out of range.
LabelingResult label_facets(const TriangleMesh& mesh,
                            const std::vector<LabeledView>& views,
                            const std::vector<FacetImage>& renderings,
                            const LabelingConfig& config);

/// Writes labels, confidence and view counts into the mesh that was labelled. A facet that was no
/// gap before does not become one (see is_gap) because no image of this set sees it.
void apply_labeling(const LabelingResult& labeling, TriangleMesh* mesh);

}  // namespace facet_mapping
