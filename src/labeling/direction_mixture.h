// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Mixtures of von Mises-Fisher distributions on the sphere (Banerjee et al. 2005, JMLR 6), built up
// greedily (Verbeek et al. 2003), so that nothing depends on chance.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace facet_mapping {

struct DirectionComponent {
  Eigen::Vector3d mean = Eigen::Vector3d::UnitZ();  ///< unit
  double concentration = 0.0;                       ///< kappa > 0; near 0 is uniform
  double weight = 1.0;                              ///< of all components together 1
};

constexpr std::size_t kMostDirections = 6;

/// As many components, at most kMostDirections, as the Bayesian information criterion asks for if
/// the unit vectors stand for `observations` independent ones, of which each component must explain
/// `least` where there is more than one. `directions` must not be empty.
std::vector<DirectionComponent> fit_directions(const std::vector<Eigen::Vector3d>& directions,
                                               double observations,
                                               double least,
                                               double largest_concentration);

/// Share of each component in a direction, together 1.
std::vector<double> component_shares(const std::vector<DirectionComponent>& components,
                                     const Eigen::Vector3d& unit);

}  // namespace facet_mapping
