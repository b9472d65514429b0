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

// Where normals look all ways alike, P / a^2 is with this deviation what it is with others.
constexpr double kAllWaysSigmaRad = 1.57;

constexpr int kShiftSteps = 60;  // bisections, down to rounding

double total_area(const Normals& normals, const FacetList& facets) {
  double area = 0.0;
  for (const std::uint32_t f : facets) {
    area += normals[f].norm();
  }
  return area;
}

/// As many facets of equal area would say as much about means (Kish 1965): a few large facets and
/// many specks are few.
double effective_count(const Normals& normals, const FacetList& facets) {
  double squares = 0.0;
  for (const std::uint32_t f : facets) {
    squares += normals[f].squaredNorm();
  }
  const double area = total_area(normals, facets);
  return area * area / squares;
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

/// Directions and weights from all facets, not from the samples alone.
OrientationMixture make_mixture(const Normals& normals,
                                const FacetList& facets,
                                const std::vector<DirectionComponent>& components,
                                double least_sigma_rad) {
  Normals sums(components.size(), Eigen::Vector3d::Zero());
  std::vector<double> areas(components.size(), 0.0);
  for_each_share(normals, facets, components, [&](std::size_t j, const auto& normal, double share) {
    sums[j] += share * normal;
    areas[j] += share * normal.norm();
  });
  std::vector<double> squares(components.size(), 0.0);
  for_each_share(normals, facets, components, [&](std::size_t j, const auto& normal, double share) {
    const double angle = angle_between(sums[j].normalized(), normal);
    squares[j] += share * normal.norm() * angle * angle;
  });
  OrientationMixture mixture;
  const double area = total_area(normals, facets);
  for (std::size_t j = 0; j < components.size(); ++j) {
    mixture.weights.push_back(areas[j] / area);
    const double sigma = std::max(std::sqrt(squares[j] / areas[j]), least_sigma_rad);
    mixture.directions.push_back(is_directed(sums[j], areas[j])
                                     ? ClassOrientation{sums[j].normalized(), sigma}
                                     : ClassOrientation{{0, 0, 0}, kAllWaysSigmaRad});
  }
  return mixture;
}

/// Without mixture.shift, nats.
double relative_cost(const OrientationMixture& mixture, const Eigen::Vector3d& normal) {
  double sum = std::numeric_limits<double>::min();
  for (std::size_t j = 0; j < mixture.directions.size(); ++j) {
    const ClassOrientation& direction = mixture.directions[j];
    sum += mixture.weights[j] / (direction.sigma_rad * direction.sigma_rad) *
           std::exp(-deviation_cost(direction, normal));
  }
  return -std::log(sum);
}

/// What the facets pay on average to the directions that they belong to.
double mean_cost(const Normals& normals,
                 const FacetList& facets,
                 const std::vector<DirectionComponent>& components,
                 const OrientationMixture& mixture,
                 double dearest) {
  double sum = 0.0;
  for_each_share(normals, facets, components, [&](std::size_t j, const auto& normal, double share) {
    const double cost = std::min(deviation_cost(mixture.directions[j], normal), dearest);
    sum += share * normal.norm() * cost;
  });
  return sum / total_area(normals, facets);
}

/// The shift of `costs` with which they are `target` on average between 0 and `dearest`.
double shift_to_mean(const std::vector<double>& costs,
                     const std::vector<double>& shares,
                     double dearest,
                     double target) {
  const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
  double low = -*most;
  double high = dearest - *least;
  for (int step = 0; step < kShiftSteps; ++step) {
    const double shift = 0.5 * (low + high);
    double mean = 0.0;
    for (std::size_t k = 0; k < costs.size(); ++k) {
      mean += shares[k] * std::clamp(costs[k] + shift, 0.0, dearest);
    }
    (mean < target ? low : high) = shift;
  }
  return 0.5 * (low + high);
}

}  // namespace
OrientationMixture fit_mixture(const Normals& normals,
                               const FacetList& facets,
                               const LabelingConfig& config) {
  if (facets.empty()) {
    return {};
  }
  const double least_sigma = least_sigma_rad(config);
  // For small angles the mean squared angle is 2 / concentration.
  const std::vector<DirectionComponent> components =
      fit_directions(area_samples(normals, facets),
                     std::min(effective_count(normals, facets), static_cast<double>(kSamples)),
                     static_cast<double>(config.min_normal_facets),
                     2.0 / (least_sigma * least_sigma));
  OrientationMixture mixture = make_mixture(normals, facets, components, least_sigma);
  const double area = total_area(normals, facets);
  std::vector<double> costs;
  std::vector<double> shares;
  for (const std::uint32_t f : facets) {
    costs.push_back(relative_cost(mixture, normals[f]));
    shares.push_back(normals[f].norm() / area);
  }
  const double dearest = dearest_cost(config);
  const double target = mean_cost(normals, facets, components, mixture, dearest);
  mixture.shift = shift_to_mean(costs, shares, dearest, target);
  return mixture;
}

MixedOrientation::MixedOrientation(const ClassFacets& facets, const LabelingConfig& config)
    : mixtures_(facets.all().size()) {
  tbb::parallel_for(std::size_t{0}, mixtures_.size(), [&](std::size_t k) {
    mixtures_[k] = fit_mixture(facets.normals(), facets.all()[k], config);
  });
}

double MixedOrientation::cost(std::size_t /*facet*/,
                              const Eigen::Vector3d& normal,
                              std::size_t index) const {
  const OrientationMixture& mixture = mixtures_[index];
  return mixture.directions.empty() ? kMeanOrientationCost
                                    : relative_cost(mixture, normal) + mixture.shift;
}

}  // namespace facet_mapping
