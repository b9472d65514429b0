// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/global_orientation.h"

namespace facet_mapping {

GlobalOrientation::GlobalOrientation(const ClassFacets& facets, const LabelingConfig& config) {
  for (const FacetList& own : facets.all()) {
    orientations_.push_back(fit_orientation(facets.normals(), own, least_sigma_rad(config)));
  }
}

double GlobalOrientation::cost(std::size_t /*facet*/,
                               const Eigen::Vector3d& normal,
                               std::size_t index) const {
  return deviation_cost(orientations_[index], normal);
}

}  // namespace facet_mapping
