// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The orientation prior with several directions per class, for classes such as buildings whose
// walls look several ways, where one mean direction says nothing.
#pragma once

#include <vector>

#include "labeling/orientation_prior.h"

namespace facet_mapping {

/// P(n) = c sum_j w_j exp(-angle(n, m_j)^2 / (2 a_j^2)) with c such that the class's own facets pay
/// on average what they pay to the direction that they belong to: 1/2, as with one direction, to
/// which it comes down where one is enough.
struct OrientationMixture {
  std::vector<ClassOrientation> directions;  ///< none if the class has no prior
  std::vector<double> weights;               ///< shares of the class's area
  double log_scale = 0.0;                    ///< log c
};

OrientationMixture fit_mixture(const std::vector<Eigen::Vector3d>& normals,
                               const FacetList& facets,
                               double least_sigma_rad);

class MixedOrientation : public OrientationModel {
 public:
  MixedOrientation(const ClassFacets& facets, const LabelingConfig& config);

  double cost(std::size_t facet, const Eigen::Vector3d& normal, std::size_t index) const override;
  const std::vector<OrientationMixture>& mixtures() const { return mixtures_; }

 private:
  std::vector<OrientationMixture> mixtures_;
};

}  // namespace facet_mapping
