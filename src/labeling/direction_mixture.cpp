// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/direction_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace facet_mapping {
namespace {

using Directions = std::vector<Eigen::Vector3d>;
using Components = std::vector<DirectionComponent>;

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kLeastConcentration = 1e-3;
constexpr int kMostSteps = 100;
constexpr double kLeastGain = 1e-5;               // nats per direction and step
constexpr double kLeastWeight = 0.02;             // a component that explains less is noise
constexpr std::size_t kCandidates = 64;           // directions tried for a new component
constexpr double kCandidateConcentration = 16.0;  // a standard deviation of 20 degrees

double density(const DirectionComponent& c, const Eigen::Vector3d& unit) {
  // Not with sinh, which overflows for concentrated components.
  return c.concentration / (kTwoPi * -std::expm1(-2.0 * c.concentration)) *
         std::exp(c.concentration * (c.mean.dot(unit) - 1.0));
}

double density(const Components& components, const Eigen::Vector3d& unit) {
  double sum = 0.0;
  for (const DirectionComponent& c : components) {
    sum += c.weight * density(c, unit);
  }
  return std::max(sum, std::numeric_limits<double>::min());
}

double mean_log_density(const Components& components, const Directions& directions) {
  double sum = 0.0;
  for (const Eigen::Vector3d& unit : directions) {
    sum += std::log(density(components, unit));
  }
  return sum / static_cast<double>(directions.size());
}

DirectionComponent component_of(const Eigen::Vector3d& sum,
                                double weight,
                                double total,
                                double largest_concentration) {
  DirectionComponent c;
  const double r = weight > 0.0 ? std::min(sum.norm() / weight, 1.0) : 0.0;
  c.mean = sum.isZero(0.0) ? Eigen::Vector3d::UnitZ() : sum.normalized();
  const double concentration = r < 1.0 ? r * (3.0 - r * r) / (1.0 - r * r) : largest_concentration;
  c.concentration = std::clamp(concentration, kLeastConcentration, largest_concentration);
  c.weight = weight / total;
  return c;
}

/// One step of expectation maximisation.
Components improved(const Components& components,
                    const Directions& directions,
                    double largest_concentration) {
  Directions sums(components.size(), Eigen::Vector3d::Zero());
  std::vector<double> weights(components.size(), 0.0);
  for (const Eigen::Vector3d& unit : directions) {
    const std::vector<double> shares = component_shares(components, unit);
    for (std::size_t j = 0; j < shares.size(); ++j) {
      sums[j] += shares[j] * unit;
      weights[j] += shares[j];
    }
  }
  Components result;
  for (std::size_t j = 0; j < components.size(); ++j) {
    result.push_back(component_of(
        sums[j], weights[j], static_cast<double>(directions.size()), largest_concentration));
  }
  return result;
}

Components converged(Components components,
                     const Directions& directions,
                     double largest_concentration) {
  double fit = mean_log_density(components, directions);
  for (int step = 0; step < kMostSteps; ++step) {
    components = improved(components, directions, largest_concentration);
    const double before = fit;
    fit = mean_log_density(components, directions);
    if (fit < before + kLeastGain) {
      break;
    }
  }
  return components;
}

/// With a further component at that candidate direction which explains the most.
Components with_candidate(Components components, const Directions& directions) {
  const double weight = 1.0 / static_cast<double>(components.size() + 1);
  std::vector<double> rest;
  for (const Eigen::Vector3d& unit : directions) {
    rest.push_back((1.0 - weight) * density(components, unit));
  }
  DirectionComponent best;
  double best_fit = -std::numeric_limits<double>::infinity();
  const std::size_t tried = std::min(kCandidates, directions.size());
  for (std::size_t k = 0; k < tried; ++k) {
    const DirectionComponent candidate{
        directions[k * directions.size() / tried], kCandidateConcentration, weight};
    double fit = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      fit += std::log(rest[i] + weight * density(candidate, directions[i]));
    }
    if (fit > best_fit) {
      best_fit = fit;
      best = candidate;
    }
  }
  for (DirectionComponent& c : components) {
    c.weight *= 1.0 - weight;
  }
  components.push_back(best);
  return components;
}

/// Bayesian information criterion over 2 n: a component has a direction, a spread and a weight.
double criterion(const Components& components, const Directions& directions, double observations) {
  const double parameters = 4.0 * static_cast<double>(components.size()) - 1.0;
  return 0.5 * parameters * std::log(observations) / observations -
         mean_log_density(components, directions);
}

double least_weight(const Components& components) {
  return std::min_element(components.begin(),
                          components.end(),
                          [](const auto& a, const auto& b) { return a.weight < b.weight; })
      ->weight;
}

}  // namespace

std::vector<DirectionComponent> fit_directions(const std::vector<Eigen::Vector3d>& directions,
                                               double observations,
                                               double least,
                                               double largest_concentration) {
  const Components uniform{{Eigen::Vector3d::UnitZ(), kLeastConcentration, 1.0}};
  Components best = improved(uniform, directions, largest_concentration);
  double lowest = criterion(best, directions, observations);
  while (best.size() < kMostDirections) {
    const Components next =
        converged(with_candidate(best, directions), directions, largest_concentration);
    const double value = criterion(next, directions, observations);
    if (value >= lowest || least_weight(next) < std::max(kLeastWeight, least / observations)) {
      break;
    }
    lowest = value;
    best = next;
  }
  return best;
}

std::vector<double> component_shares(const std::vector<DirectionComponent>& components,
                                     const Eigen::Vector3d& unit) {
  std::vector<double> shares;
  double sum = 0.0;
  for (const DirectionComponent& c : components) {
    shares.push_back(c.weight * density(c, unit) + std::numeric_limits<double>::min());
    sum += shares.back();
  }
  for (double& share : shares) {
    share /= sum;
  }
  return shares;
}

}  // namespace facet_mapping
