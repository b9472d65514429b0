// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// P_norm of the paper: how a class's facets are oriented, in the form that the configuration names
// (see OrientationPrior). Learned from the mesh itself, so that it knows neither units nor which
// way is up.
#pragma once

#include <memory>
#include <vector>

#include "labeling/class_facets.h"
#include "labeling/facet_graph.h"
#include <Eigen/Core>

#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

/// What the orientation of the facets says about their classes.
class OrientationModel {
 public:
  OrientationModel() = default;
  OrientationModel(const OrientationModel&) = delete;
  OrientationModel& operator=(const OrientationModel&) = delete;
  virtual ~OrientationModel() = default;

  /// -log P_norm of class `index` at a facet with the normal `normal` (any length above 0), nats:
  /// 1/2 on average over a class's own facets (less where min_normal_sigma_deg is more than its
  /// deviation), and 1/2 for a class without a prior.
  virtual double cost(std::size_t facet,
                      const Eigen::Vector3d& normal,
                      std::size_t index) const = 0;
};

/// Of the form config.orientation_prior. `graph`: of the facets that `facets` speaks of.
std::unique_ptr<const OrientationModel> make_orientation_model(const ClassFacets& facets,
                                                               const FacetGraph& graph,
                                                               const LabelingConfig& config);

/// -log min(1, max(normal_floor, P_norm)); 0 for facets without area.
double orientation_cost(const OrientationModel& model,
                        std::size_t facet,
                        const Eigen::Vector3d& normal,
                        std::size_t index,
                        const LabelingConfig& config);

/// min_normal_sigma_deg in rad.
double least_sigma_rad(const LabelingConfig& config);

/// -log normal_floor, nats.
double dearest_cost(const LabelingConfig& config);

}  // namespace facet_mapping
