// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's form of the orientation prior (Romanoni et al. 2017): one mean direction per class.
// For a class with walls in every direction the deviation becomes large and the prior says nothing.
#pragma once

#include <vector>

#include "labeling/orientation_prior.h"

namespace facet_mapping {

class GlobalOrientation : public OrientationModel {
 public:
  GlobalOrientation(const ClassFacets& facets, const LabelingConfig& config);

  double cost(std::size_t facet, const Eigen::Vector3d& normal, std::size_t index) const override;
  const std::vector<ClassOrientation>& orientations() const { return orientations_; }

 private:
  std::vector<ClassOrientation> orientations_;
};

}  // namespace facet_mapping
