// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/orientation_prior.h"

#include <algorithm>
#include <cmath>

#include "labeling/global_orientation.h"
#include "labeling/local_orientation.h"
#include "labeling/mixed_orientation.h"

namespace facet_mapping {

std::unique_ptr<const OrientationModel> make_orientation_model(const ClassFacets& facets,
                                                               const FacetGraph& graph,
                                                               const LabelingConfig& config) {
  switch (config.orientation_prior) {
    case OrientationPrior::kMixture:
      return std::make_unique<MixedOrientation>(facets, config);
    case OrientationPrior::kLocal:
      return std::make_unique<LocalOrientation>(facets, graph, config);
    case OrientationPrior::kGlobal:
      break;
  }
  return std::make_unique<GlobalOrientation>(facets, config);
}

double orientation_cost(const OrientationModel& model,
                        std::size_t facet,
                        const Eigen::Vector3d& normal,
                        std::size_t index,
                        const LabelingConfig& config) {
  if (normal.isZero(0.0)) {
    return 0.0;
  }
  return std::clamp(model.cost(facet, normal, index), 0.0, dearest_cost(config));
}

double least_sigma_rad(const LabelingConfig& config) {
  constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
  return config.min_normal_sigma_deg * kRadiansPerDegree;
}

double dearest_cost(const LabelingConfig& config) {
  return -std::log(config.normal_floor);
}

}  // namespace facet_mapping
