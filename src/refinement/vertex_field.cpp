// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/vertex_field.h"

#include <algorithm>

namespace facet_mapping {

void VertexField::add(const VertexField& other, double weight) {
  for (std::size_t k = 0; k < gradient.size(); ++k) {
    gradient[k] += weight * other.gradient[k];
    curvature[k] += weight * other.curvature[k];
  }
}

void VertexField::clear() {
  std::fill(gradient.begin(), gradient.end(), Eigen::Vector3d::Zero());
  std::fill(curvature.begin(), curvature.end(), 0.0);
}

}  // namespace facet_mapping
