// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// P_norm of the paper: how a class's facets are oriented. One mean direction per class: for a class
// with walls in every direction the deviation becomes large and the prior says nothing, as it
// should.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "facet_mapping/labeling/alpha_expansion.h"
#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

struct ClassOrientation {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< unit; zero if the class has no prior
  double sigma_rad = 0.0;                          ///< angular standard deviation, area-weighted
};

/// Of each class, from the facets now labelled with it; from `fallback` where `labels` gives a
/// class too few facets, and none where that does too. `labels` and `fallback` hold kNoClass or a
/// class. `normals`: unit normals times area.
std::vector<ClassOrientation> estimate_orientations(const std::vector<Eigen::Vector3d>& normals,
                                                    const std::vector<ClassIndex>& labels,
                                                    const std::vector<ClassIndex>& fallback,
                                                    std::size_t classes,
                                                    const LabelingConfig& config);

/// -log max(normal_floor, P_norm) of a facet, nats: 1/2 on average over a class's own facets, and
/// so 1/2 for a class without a prior; 0 for facets without area.
double orientation_cost(const ClassOrientation& orientation,
                        const Eigen::Vector3d& normal,
                        const LabelingConfig& config);

}  // namespace facet_mapping
