// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/direction_mixture.h"

#include <algorithm>
#include <vector>

#include "oriented_facets.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

constexpr double kLeast = 20.0;

const std::vector<Eigen::Vector3d> kKnown{Eigen::Vector3d::UnitX(),
                                          Eigen::Vector3d(0, 0.6, 0.8),
                                          -Eigen::Vector3d::UnitX(),
                                          -Eigen::Vector3d::UnitZ(),
                                          Eigen::Vector3d(0, -1, 0)};

/// `count` directions around each of the first `known` of them, twice as many around the first.
std::vector<Eigen::Vector3d> around_known(std::size_t known, int count, double spread_deg) {
  std::mt19937 random(5);
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t j = 0; j < known; ++j) {
    for (int k = 0; k < (j == 0 ? 2 * count : count); ++k) {
      directions.push_back(test::near_direction(kKnown[j], spread_deg, &random));
    }
  }
  return directions;
}

double largest_concentration() {
  return 2.0 / (25.0 * test::kDegree * test::kDegree);
}

TEST(DirectionMixture, FindsTheKnownDirectionsAndTheirShares) {
  for (std::size_t known = 1; known <= kKnown.size(); ++known) {
    const auto directions = around_known(known, 200, 7.0);
    const auto components = fit_directions(
        directions, static_cast<double>(directions.size()), kLeast, largest_concentration());
    ASSERT_EQ(components.size(), known);
    for (std::size_t j = 0; j < known; ++j) {
      const auto nearest = *std::max_element(
          components.begin(), components.end(), [&](const auto& a, const auto& b) {
            return a.mean.dot(kKnown[j]) < b.mean.dot(kKnown[j]);
          });
      EXPECT_GT(nearest.mean.dot(kKnown[j]), std::cos(1.5 * test::kDegree));
      EXPECT_NEAR(nearest.weight, (j == 0 ? 2.0 : 1.0) / static_cast<double>(known + 1), 0.01);
      // The mean squared angle is 2 / concentration; here it is the spread's square.
      EXPECT_NEAR(std::sqrt(2.0 / nearest.concentration), 7.0 * test::kDegree, 1.0 * test::kDegree);
    }
  }
}

TEST(DirectionMixture, EqualInAllDirectionsIsOneWideComponent) {
  std::mt19937 random(3);
  std::vector<Eigen::Vector3d> directions(1000);
  std::generate(directions.begin(), directions.end(), [&] { return test::random_unit(&random); });
  const auto components = fit_directions(directions, 1000.0, kLeast, largest_concentration());
  ASSERT_EQ(components.size(), 1U);
  EXPECT_LT(components[0].concentration, 0.3);
}

TEST(DirectionMixture, FewerObservationsAskForFewerComponents) {
  // Two directions 12 degrees apart, each with a spread of 7: hardly to be told apart.
  std::mt19937 random(9);
  std::vector<Eigen::Vector3d> directions;
  for (int k = 0; k < 1000; ++k) {
    const double angle = k % 2 == 0 ? 0.0 : 12.0 * test::kDegree;
    directions.push_back(
        test::near_direction({std::sin(angle), 0.0, std::cos(angle)}, 7.0, &random));
  }
  EXPECT_EQ(fit_directions(directions, 20.0, 0.0, largest_concentration()).size(), 1U);
  EXPECT_GT(fit_directions(directions, 1000.0, 0.0, largest_concentration()).size(), 1U);
}

TEST(DirectionMixture, DirectionsThatTooFewAskForAreLeftOut) {
  const auto directions = around_known(2, 100, 7.0);
  EXPECT_EQ(fit_directions(directions, 300.0, 90.0, largest_concentration()).size(), 2U);
  EXPECT_EQ(fit_directions(directions, 300.0, 110.0, largest_concentration()).size(), 1U);
}

TEST(DirectionMixture, SharesAddUpAndFarDirectionsHaveAFiniteOne) {
  const auto directions = around_known(3, 100, 5.0);
  const auto components = fit_directions(directions, 400.0, kLeast, largest_concentration());
  for (const Eigen::Vector3d& unit : kKnown) {
    const std::vector<double> shares = component_shares(components, unit);
    double sum = 0.0;
    for (const double share : shares) {
      EXPECT_GE(share, 0.0);
      sum += share;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(DirectionMixture, OneDirectionAloneIsFitted) {
  const auto components = fit_directions({Eigen::Vector3d::UnitY()}, 1.0, kLeast, 50.0);
  ASSERT_EQ(components.size(), 1U);
  EXPECT_EQ(components[0].concentration, 50.0);
  EXPECT_EQ(components[0].mean, Eigen::Vector3d::UnitY());
}

}  // namespace
}  // namespace facet_mapping
