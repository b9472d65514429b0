// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/mixed_orientation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "labeling/direction_mixture.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

using Normals = std::vector<Eigen::Vector3d>;

// Enough for a few directions, and few enough that large classes take no longer than small ones.
constexpr std::size_t kSamples = 2048;

double total_area(const Normals& normals, const FacetList& facets) {
  double area = 0.0;
  for (const std::uint32_t f : facets) {
    area += normals[f].norm();
  }
  return area;
}

/// Unit normals at equal steps of the area, facet after facet.
Normals area_samples(const Normals& normals, const FacetList& facets) {
  const double area = total_area(normals, facets);
  Normals samples;
  double passed = 0.0;
  for (const std::uint32_t f : facets) {
    passed += normals[f].norm() / area * static_cast<double>(kSamples);
    while (static_cast<double>(samples.size()) + 0.5 < passed) {
      samples.push_back(normals[f].normalized());
    }
  }
  return samples;
}

/// Calls visit(component, normal, share of the component in it).
template <typename Visit>
void for_each_share(const Normals& normals,
                    const FacetList& facets,
                    const std::vector<DirectionComponent>& components,
                    const Visit& visit) {
  for (const std::uint32_t f : facets) {
    const std::vector<double> shares = component_shares(components, normals[f].normalized());
    for (std::size_t j = 0; j < shares.size(); ++j) {
      visit(j, normals[f], shares[j]);
    }
  }
}

/// Directions and weights from all facets, not from the samples alone. Returns what the facets pay
/// on average to the directions that they belong to.
double fill_directions(const Normals& normals,
                       const FacetList& facets,
                       const std::vector<DirectionComponent>& components,
                       double least_sigma_rad,
                       OrientationMixture* mixture) {
  Normals sums(components.size(), Eigen::Vector3d::Zero());
  std::vector<double> areas(components.size(), 0.0);
  for_each_share(normals, facets, components, [&](std::size_t j, const auto& normal, double share) {
    sums[j] += share * normal;
    areas[j] += share * normal.norm();
  });
  mixture->directions.resize(components.size());
  for (std::size_t j = 0; j < components.size(); ++j) {
    if (is_directed(sums[j], areas[j])) {
      mixture->directions[j] = {sums[j].normalized(), 1.0};
    }
  }
  // With a deviation of 1 rad the cost is half the squared angle.
  std::vector<double> costs(components.size(), 0.0);
  for_each_share(normals, facets, components, [&](std::size_t j, const auto& normal, double share) {
    costs[j] += share * normal.norm() * deviation_cost(mixture->directions[j], normal);
  });
  const double area = total_area(normals, facets);
  double mean_cost = 0.0;
  for (std::size_t j = 0; j < components.size(); ++j) {
    ClassOrientation& direction = mixture->directions[j];
    if (!direction.mean.isZero(0.0)) {
      direction.sigma_rad = std::max(std::sqrt(2.0 * costs[j] / areas[j]), least_sigma_rad);
      costs[j] /= direction.sigma_rad * direction.sigma_rad;
    }
    mixture->weights.push_back(areas[j] / area);
    mean_cost += costs[j] / area;
  }
  return mean_cost;
}

double log_density(const OrientationMixture& mixture, const Eigen::Vector3d& normal) {
  double sum = std::numeric_limits<double>::min();
  for (std::size_t j = 0; j < mixture.directions.size(); ++j) {
    sum += mixture.weights[j] * std::exp(-deviation_cost(mixture.directions[j], normal));
  }
  return std::log(sum);
}

}  // namespace

OrientationMixture fit_mixture(const Normals& normals,
                               const FacetList& facets,
                               double least_sigma_rad) {
  OrientationMixture mixture;
  if (facets.empty()) {
    return mixture;
  }
  // For small angles the mean squared angle is 2 / concentration.
  const std::vector<DirectionComponent> components =
      fit_directions(area_samples(normals, facets),
                     static_cast<double>(std::min(facets.size(), kSamples)),
                     2.0 / (least_sigma_rad * least_sigma_rad));
  const double mean_cost = fill_directions(normals, facets, components, least_sigma_rad, &mixture);
  const double area = total_area(normals, facets);
  double mean_log = 0.0;
  for (const std::uint32_t f : facets) {
    mean_log += normals[f].norm() / area * log_density(mixture, normals[f]);
  }
  mixture.log_scale = -mean_cost - mean_log;
  return mixture;
}

MixedOrientation::MixedOrientation(const ClassFacets& facets, const LabelingConfig& config)
    : mixtures_(facets.all().size()) {
  tbb::parallel_for(std::size_t{0}, mixtures_.size(), [&](std::size_t k) {
    mixtures_[k] = fit_mixture(facets.normals(), facets.all()[k], least_sigma_rad(config));
  });
}

double MixedOrientation::cost(std::size_t /*facet*/,
                              const Eigen::Vector3d& normal,
                              std::size_t index) const {
  const OrientationMixture& mixture = mixtures_[index];
  return mixture.directions.empty() ? kMeanOrientationCost
                                    : -mixture.log_scale - log_density(mixture, normal);
}

}  // namespace facet_mapping
