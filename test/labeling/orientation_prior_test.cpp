// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What holds for every form of the orientation prior, and for the mixture of directions.
#include "labeling/orientation_prior.h"

#include <vector>

#include "labeling/mixed_orientation.h"
#include "oriented_facets.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using test::OrientedFacets;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// A road (class 0) and a building with walls to four sides, one of them large (class 1).
OrientedFacets street() {
  OrientedFacets facets;
  facets.add(300, kUp, 4.0, 0);
  facets.add(300, {1, 0, 0}, 14.0, 1);
  facets.add(100, {0, 1, 0}, 14.0, 1);
  facets.add(100, {-1, 0, 0}, 14.0, 1);
  facets.add(100, {0, -1, 0}, 14.0, 1);
  return facets;
}

class EveryOrientationPrior : public testing::TestWithParam<OrientationPrior> {
 protected:
  LabelingConfig config_ = test::with_prior(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Forms,
                         EveryOrientationPrior,
                         testing::Values(OrientationPrior::kGlobal,
                                         OrientationPrior::kMixture,
                                         OrientationPrior::kLocal));

TEST_P(EveryOrientationPrior, OwnFacetsPayOneHalfOnAverageAndFlatClassesLess) {
  OrientedFacets facets = street();
  config_.normal_floor = 1e-6;  // so that no facet reaches it
  const auto model = facets.model(config_, 2);
  EXPECT_NEAR(test::own_cost(*model, facets, 1, config_), 0.5, 1e-9);
  EXPECT_LT(test::own_cost(*model, facets, 0, config_), 0.2);
  config_.normal_floor = 0.2;
  const auto floored = facets.model(config_, 2);
  EXPECT_LT(test::own_cost(*floored, facets, 1, config_), 0.5);
  EXPECT_GT(test::own_cost(*floored, facets, 1, config_), 0.4);
}

TEST_P(EveryOrientationPrior, UnitsAndTurnsOfTheSceneDoNotMatter) {
  const OrientedFacets facets = street();
  OrientedFacets changed = facets;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).matrix();
  for (Eigen::Vector3d& normal : changed.normals) {
    normal = 1e6 * turn * normal;
  }
  const auto expected = facets.model(config_, 2);
  const auto model = changed.model(config_, 2);
  for (std::size_t f = 0; f < facets.normals.size(); ++f) {
    for (const std::size_t k : {0, 1}) {
      ASSERT_NEAR(
          model->cost(f, changed.normals[f], k), expected->cost(f, facets.normals[f], k), 1e-6);
    }
  }
}

TEST_P(EveryOrientationPrior, NumberingOfTheClassesDoesNotMatter) {
  const OrientedFacets facets = street();
  OrientedFacets swapped = facets;
  for (ClassIndex& label : swapped.labels) {
    label = static_cast<ClassIndex>(2 - label);
  }
  const auto expected = facets.model(config_, 2);
  const auto model = swapped.model(config_, 3);
  for (std::size_t f = 0; f < facets.normals.size(); ++f) {
    for (const std::size_t k : {0, 1}) {
      ASSERT_EQ(model->cost(f, facets.normals[f], 2 - k), expected->cost(f, facets.normals[f], k));
    }
  }
}

TEST_P(EveryOrientationPrior, ClassesWithTooFewFacetsUseTheFallbackOrKnowNothing) {
  OrientedFacets facets;
  facets.add(200, kUp, 5.0, 0);
  facets.add(config_.min_normal_facets - 1, {1, 0, 0}, 5.0, 1);
  facets.add(config_.min_normal_facets - 1, {0, 1, 0}, 5.0, 2);
  // The fallback has class 1 where the labels have class 0, and class 2 nowhere else.
  std::vector<ClassIndex> fallback = facets.labels;
  std::fill(fallback.begin(), fallback.begin() + 200, ClassIndex{1});
  const auto model = make_orientation_model(
      ClassFacets(facets.normals, facets.labels, fallback, 4, config_), facets.graph(), config_);
  EXPECT_LT(model->cost(0, kUp, 0), 0.1);
  EXPECT_LT(model->cost(0, kUp, 1), 0.1);
  EXPECT_GT(model->cost(0, {1, 0, 0}, 0), 3.0);
  for (const Eigen::Vector3d& normal : {kUp, Eigen::Vector3d(0, 1, 0)}) {
    EXPECT_EQ(model->cost(0, normal, 2), 0.5);
    EXPECT_EQ(model->cost(0, normal, 3), 0.5);
  }
}

TEST_P(EveryOrientationPrior, AreaCountsNotTheNumberOfFacets) {
  // Many specks look sideways; nearly all of the area looks up.
  OrientedFacets facets;
  facets.add(50, kUp, 5.0, 0);
  facets.add(500, {1, 0, 0}, 5.0, 0);
  for (std::size_t f = 50; f < facets.normals.size(); ++f) {
    facets.normals[f] *= 1e-5;
  }
  const auto model = facets.model(config_, 1);
  EXPECT_LT(model->cost(0, kUp, 0), 0.1);
  EXPECT_GT(model->cost(0, {1, 0, 0}, 0), 3.0);
}

TEST_P(EveryOrientationPrior, CostsLieBetweenZeroAndTheFloorAndAreZeroWithoutArea) {
  const OrientedFacets facets = street();
  const auto model = facets.model(config_, 3);
  const auto cost = [&](const Eigen::Vector3d& normal, std::size_t index) {
    return orientation_cost(*model, 0, normal, index, config_);
  };
  EXPECT_DOUBLE_EQ(cost({1, 0, 0}, 0), -std::log(config_.normal_floor));
  EXPECT_EQ(cost({0, 0, 0}, 0), 0.0);
  EXPECT_EQ(cost({0, 0, 5}, 2), 0.5);
  std::mt19937 random(2);
  for (int k = 0; k < 200; ++k) {
    const double value = cost(test::random_unit(&random), 1);
    EXPECT_GE(value, 0.0);
    EXPECT_LE(value, -std::log(config_.normal_floor));
  }
  EXPECT_GE(cost({1, 0, 0}, 1), 0.0);
}

TEST(MixedOrientation, IsCheapAtEachWallAndDearBetweenWhereOneDirectionSaysNothing) {
  OrientedFacets facets;
  const std::vector<Eigen::Vector3d> walls{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const Eigen::Vector3d& wall : walls) {
    facets.add(200, wall, 6.0, 0);
  }
  const auto mixture = facets.model(test::with_prior(OrientationPrior::kMixture), 1);
  const auto global = facets.model(test::with_prior(OrientationPrior::kGlobal), 1);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    EXPECT_LT(mixture->cost(0, walls[k], 0), 0.1);
    EXPECT_GT(mixture->cost(0, walls[k] + walls[(k + 1) % 4], 0), 3.0);
    EXPECT_GT(mixture->cost(0, walls[k] + 2.0 * kUp, 0), 3.0);
  }
  EXPECT_LT(global->cost(0, kUp, 0), 1.0);
}

TEST(MixedOrientation, RareDirectionsCostMoreThanFrequentOnes) {
  const OrientedFacets facets = street();
  const auto model = facets.model(test::with_prior(OrientationPrior::kMixture), 2);
  const double large = model->cost(0, {1, 0, 0}, 1);
  const double small = model->cost(0, {0, 1, 0}, 1);
  EXPECT_NEAR(small - large, std::log(3.0), 0.25);
}

TEST(MixedOrientation, OneDirectionIsTheGlobalForm) {
  OrientedFacets facets;
  facets.add(3000, {0.3, 0.2, 1.0}, 12.0, 0);
  const auto mixture = facets.model(test::with_prior(OrientationPrior::kMixture), 1);
  const auto global = facets.model(test::with_prior(OrientationPrior::kGlobal), 1);
  for (std::size_t f = 0; f < facets.normals.size(); ++f) {
    ASSERT_NEAR(
        mixture->cost(f, facets.normals[f], 0), global->cost(f, facets.normals[f], 0), 1e-9);
  }
}

TEST(MixedOrientation, NormalsThatCancelOutSayNothing) {
  OrientedFacets facets;
  std::mt19937 random(4);
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d unit = test::random_unit(&random);
    facets.normals.insert(facets.normals.end(), {unit, -unit});
    facets.labels.insert(facets.labels.end(), {0, 0});
  }
  const auto model = facets.model(test::with_prior(OrientationPrior::kMixture), 1);
  EXPECT_NEAR(model->cost(0, kUp, 0), 0.5, 1e-9);
  EXPECT_NEAR(model->cost(0, {1, 0, 0}, 0), 0.5, 1e-9);
}

}  // namespace
}  // namespace facet_mapping
