// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The semantic forces of one view.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/semantic_energy.h"
#include "facet_mapping/refinement/semantic_gate.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

struct VertexForce {
  std::uint32_t vertex = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double curvature = 0.0;
  bool occluding = false;
};

/// Visits every pair of neighbouring pixels that show different classes: each crosses one pixel's
/// length of border, measured along the other axis, so that the pairs along the rows and those
/// along the columns together integrate the border's normal exactly.
std::vector<VertexForce> border_forces(const TriangleMesh& mesh,
                                       const std::vector<FacetNeighbours>& neighbours,
                                       const SemanticView& view,
                                       const FacetImage& image,
                                       const SemanticGate& gate);

}  // namespace facet_mapping
