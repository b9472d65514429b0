// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/energy_history.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

RefineProgress sample(int level, int iteration, double fraction, double seconds) {
  RefineProgress progress;
  progress.level = level;
  progress.iteration = iteration;
  progress.fraction = fraction;
  progress.seconds = seconds;
  return progress;
}

TEST(EnergyHistory, LevelsAreStretches) {
  EnergyHistory history;
  EXPECT_TRUE(history.levels().empty());
  EXPECT_TRUE(history.add(sample(1, 0, 0.25, 1.0)));
  EXPECT_FALSE(history.add(sample(1, 1, 0.5, 2.0)));
  EXPECT_FALSE(history.add(sample(0, 0, 0.75, 5.0)));
  const auto levels = history.levels();
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0].level, 1);
  EXPECT_EQ(levels[0].end, 2U);
  EXPECT_EQ(levels[1].level, 0);
  EXPECT_EQ(levels[1].begin, 2U);
  EXPECT_EQ(levels[1].end, 3U);
}

TEST(EnergyHistory, AnotherJobBeginsAnew) {
  EnergyHistory history;
  history.add(sample(1, 0, 0.25, 1.0));
  history.add(sample(1, 1, 0.5, 2.0));
  EXPECT_TRUE(history.add(sample(1, 0, 0.25, 3.0))) << "went back";
  EXPECT_EQ(history.samples().size(), 1U);
  EXPECT_TRUE(history.add(sample(0, 0, 0.5, 1.0))) << "its clock went back: fewer iterations";
  EXPECT_EQ(history.samples().size(), 1U);
  EXPECT_TRUE(history.add(sample(0, 0, 0.5, 1.5))) << "a job of one iteration, again";
}

TEST(EnergyHistory, PlacesAreThoseOfTheWholeJobUnlessItIsLong) {
  EnergyHistory history;
  EXPECT_EQ(history.places(), 10U);
  history.add(sample(1, 0, 0.125, 1.0));
  EXPECT_EQ(history.places(), 8U);
  history.clear();
  for (int k = 0; k < 20; ++k) {
    history.add(sample(0, k, (k + 1) / 1000.0, k + 1.0));
    EXPECT_EQ(history.places(), std::max(std::size_t{10}, 2 * history.samples().size()));
  }
  history.add(sample(0, 20, 1.0, 30.0));
  EXPECT_EQ(history.places(), 21U);
  history.add(sample(0, 0, NAN, 1.0));
  EXPECT_EQ(history.places(), 10U);
}

TEST(PlotAxis, EndsAndStepsAreRound) {
  const PlotAxis axis = axis_over({0.312, 0.268, 0.291}, 3);
  EXPECT_DOUBLE_EQ(axis.step, 0.02);
  EXPECT_NEAR(axis.low, 0.26, 1e-12);
  EXPECT_NEAR(axis.high, 0.32, 1e-12);
  EXPECT_EQ(axis.text(axis.low), "0.26");
  EXPECT_NEAR(axis.share(0.29), 0.5, 1e-9);
  EXPECT_EQ(axis_over({0.0, 3.0}, 3).text(2.0), "2");
  EXPECT_EQ(axis_over({10.0, 2500.0}, 3).text(2000.0), "2000");
}

TEST(PlotAxis, HoldsWhateverValuesThereAre) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-8.0, 5.0);
  std::uniform_real_distribution<double> sign(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const std::vector<double> values = {sign(random) * std::pow(10.0, exponent(random)),
                                        sign(random) * std::pow(10.0, exponent(random))};
    const int max_steps = 2 + k % 5;
    const PlotAxis axis = axis_over(values, max_steps);
    const double steps = (axis.high - axis.low) / axis.step;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
    EXPECT_LE(steps, max_steps + 0.5);
    EXPECT_GE(steps, 0.5);
    for (const double value : values) {
      EXPECT_GE(axis.share(value), -1e-9) << value;
      EXPECT_LE(axis.share(value), 1.0 + 1e-9) << value;
    }
  }
}

TEST(PlotAxis, EqualValuesAndNoneAtAll) {
  const PlotAxis one = axis_over({0.3, 0.3}, 3);
  EXPECT_LT(one.low, one.high);
  EXPECT_GE(one.share(0.3), 0.0);
  EXPECT_LE(one.share(0.3), 1.0);
  EXPECT_LT(axis_over({0.0}, 3).low, axis_over({0.0}, 3).high);
  const PlotAxis none = axis_over({NAN, INFINITY}, 3);
  EXPECT_LT(none.low, none.high);
  EXPECT_DOUBLE_EQ(axis_over({NAN, 2.0, 4.0}, 2).low, 2.0);
}

}  // namespace
}  // namespace facet_mapping
