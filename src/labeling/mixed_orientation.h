// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The orientation prior with several directions per class, for classes such as buildings whose
// walls look several ways, where one mean direction says nothing.
#pragma once

#include <vector>

#include "labeling/orientation_prior.h"

namespace facet_mapping {

/// -log P(n) = shift - log sum_j w_j / a_j^2 exp(-angle(n, m_j)^2 / (2 a_j^2)), the sum being a
/// density on the sphere. The shift stands for what the form with one direction leaves out, the
/// density's scale: with it the class's own facets pay on average what they pay to the direction
/// that they belong to, 1/2 at most. With one direction it is the global form.
struct OrientationMixture {
  std::vector<ClassOrientation> directions;  ///< none if the class has no prior
  std::vector<double> weights;               ///< shares of the class's area
  double shift = 0.0;                        ///< nats
};

/// Classes and directions need at least min_normal_facets facets of equal area or the like.
OrientationMixture fit_mixture(const std::vector<Eigen::Vector3d>& normals,
                               const FacetList& facets,
                               const LabelingConfig& config);

class MixedOrientation : public OrientationModel {
 public:
  MixedOrientation(const ClassFacets& facets, const LabelingConfig& config);

  double cost(std::size_t facet, const Eigen::Vector3d& normal, std::size_t index) const override;
  const std::vector<OrientationMixture>& mixtures() const { return mixtures_; }

 private:
  std::vector<OrientationMixture> mixtures_;
};

}  // namespace facet_mapping
