// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The orientation prior from the neighbourhood of each facet (after Romanoni and Matteucci 2018,
// arXiv 1807.09999): a road that climbs or a street that turns is judged by what is around it.
#pragma once

#include <cstdint>
#include <vector>

#include "labeling/facet_patches.h"
#include "labeling/orientation_prior.h"

namespace facet_mapping {

/// As the global form, with each class's mean direction and deviation from the facets around (see
/// local_facets) and, as if they were a quarter of a neighbourhood more, from all of the mesh; from
/// the latter alone where fewer than min_normal_facets around have the class.
class LocalOrientation : public OrientationModel {
 public:
  LocalOrientation(const ClassFacets& facets,
                   const FacetGraph& graph,
                   const LabelingConfig& config);

  double cost(std::size_t facet, const Eigen::Vector3d& normal, std::size_t index) const override;

 private:
  void normalise(const ClassFacets& facets);
  const ClassOrientation& around(std::size_t facet, std::size_t index) const {
    return orientations_[patches_.patch_of[facet] * scale_.size() + index];
  }

  FacetPatches patches_;
  std::vector<ClassOrientation> orientations_;  ///< patches rows of one per class
  std::vector<double> scale_;                   ///< per class, of the cost
};

}  // namespace facet_mapping
