// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The two-view semantic energy of Blaha et al. 2017, the baseline that the paper compares with.
#pragma once

#include <cstddef>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/semantic_energy.h"
#include "facet_mapping/refinement/surface_view.h"
#include "facet_mapping/refinement/vertex_field.h"

namespace facet_mapping {

struct PairwiseSemanticEnergy {
  double sum = 0.0;        ///< sum over pairs, pixels and classes of (M_i - M_j)^2
  std::size_t pixels = 0;  ///< pixels of all pairs that say something
  VertexField field;       ///< of `sum`; empty unless asked for
};

/// E = sum over ordered pairs (i, j in partners[i]), pixels u of i and classes l of
/// (M_i^l(u) - M_j^l(P_j(x)))^2, the masks of j made smooth by the cubic B-spline; the mesh's own
/// labels play no part. The gradient is that of the photometric energy with masks for images.
PairwiseSemanticEnergy pairwise_semantic_energy(const TriangleMesh& mesh,
                                                const std::vector<SemanticView>& views,
                                                const std::vector<SurfaceView>& surfaces,
                                                const std::vector<std::vector<int>>& partners,
                                                bool with_gradient);

}  // namespace facet_mapping
