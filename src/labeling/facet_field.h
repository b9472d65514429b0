// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The random field of one mesh and its segmentations, ready to be minimised.
#pragma once

#include <cstdint>
#include <vector>

#include "labeling/facet_graph.h"
#include "labeling/votes.h"

#include "facet_mapping/labeling/alpha_expansion.h"
#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

struct FacetField {
  PottsProblem problem;
  std::vector<ClassIndex> own;    ///< the mesh's labels, kNoClass where it has none
  std::vector<ClassIndex> start;  ///< arg-max data labels spread over the mesh, kNoClass = no reach
  std::vector<bool> evident;      ///< facets with a data term or a label of their own
};

/// Needs at least one class in `votes`.
FacetField make_field(const TriangleMesh& mesh,
                      const Votes& votes,
                      const FacetGraph& graph,
                      const LabelingConfig& config);

/// Margin of each facet's label in its local posterior, see LabelingResult::confidence.
std::vector<float> label_margins(const FacetField& field,
                                 const FacetGraph& graph,
                                 const std::vector<ClassIndex>& labels);

}  // namespace facet_mapping
