// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One direction with a Gaussian in the angle to it: the piece that all forms of the orientation
// prior are made of.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping {

/// What a class pays on average at its own facets, nats, and so what one without a prior pays: for
/// free, unknown classes would win everywhere.
constexpr double kMeanOrientationCost = 0.5;

using FacetList = std::vector<std::uint32_t>;

struct ClassOrientation {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< unit; zero if there is no prior
  double sigma_rad = 0.0;                          ///< angular standard deviation, area-weighted
};

/// `unit` must have length 1, `normal` any above 0.
double angle_between(const Eigen::Vector3d& unit, const Eigen::Vector3d& normal);

/// False where normals cancel out, so that the direction of their sum is noise.
bool is_directed(const Eigen::Vector3d& sum, double area);

/// Of the facets in `facets`, which must have some area together; without mean if they are not
/// directed. `normals`: unit normals times area, of all facets.
ClassOrientation fit_orientation(const std::vector<Eigen::Vector3d>& normals,
                                 const FacetList& facets,
                                 double least_sigma_rad);

/// 1/2 (angle / sigma)^2, nats; kMeanOrientationCost without a prior.
double deviation_cost(const ClassOrientation& orientation, const Eigen::Vector3d& normal);

}  // namespace facet_mapping
