// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labeling/alpha_expansion.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

/// Small whole costs, so that ties are frequent: they are what a minimum cut can get wrong.
PottsProblem random_problem(std::size_t nodes,
                            std::size_t classes,
                            int largest_cost,
                            std::mt19937* random) {
  std::uniform_int_distribution<int> cost(0, largest_cost);
  PottsProblem problem;
  problem.nodes = nodes;
  problem.classes = classes;
  for (std::size_t k = 0; k < nodes * classes; ++k) {
    problem.unary.push_back(cost(*random));
  }
  for (std::uint32_t a = 0; a < nodes; ++a) {
    for (std::uint32_t b = a + 1; b < nodes; ++b) {
      if (cost(*random) * 2 <= largest_cost) {
        problem.edges.push_back({a, b, cost(*random)});
      }
    }
  }
  return problem;
}

std::vector<ClassIndex> random_labels(const PottsProblem& problem, std::mt19937* random) {
  std::vector<ClassIndex> labels(problem.nodes);
  for (ClassIndex& label : labels) {
    label = static_cast<ClassIndex>((*random)() % problem.classes);
  }
  return labels;
}

std::int64_t lowest_energy(const PottsProblem& problem) {
  std::vector<ClassIndex> labels(problem.nodes, 0);
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
  while (true) {
    lowest = std::min(lowest, potts_energy(problem, labels));
    std::size_t node = 0;
    while (node < labels.size() && ++labels[node] == problem.classes) {
      labels[node++] = 0;
    }
    if (node == labels.size()) {
      return lowest;
    }
  }
}

/// The lowest energy that any single move to `target` reaches.
std::int64_t lowest_after_move(const PottsProblem& problem,
                               const std::vector<ClassIndex>& labels,
                               ClassIndex target) {
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
  for (std::uint32_t set = 0; set < (1U << problem.nodes); ++set) {
    std::vector<ClassIndex> moved = labels;
    for (std::size_t node = 0; node < moved.size(); ++node) {
      moved[node] = ((set >> node) & 1U) != 0 ? target : moved[node];
    }
    lowest = std::min(lowest, potts_energy(problem, moved));
  }
  return lowest;
}

TEST(AlphaExpansion, IsExactForTwoClasses) {
  std::mt19937 random(1);
  for (int k = 0; k < 400; ++k) {
    const PottsProblem problem = random_problem(2 + k % 9, 2, 1 + k % 7, &random);
    const PottsSolution solution = minimise_potts(problem, random_labels(problem, &random), 10);
    ASSERT_EQ(solution.energies.back(), lowest_energy(problem)) << "problem " << k;
  }
}

TEST(AlphaExpansion, NoMoveImprovesTheResultAndTheBoundHolds) {
  std::mt19937 random(2);
  for (int k = 0; k < 200; ++k) {
    const PottsProblem problem = random_problem(3 + k % 5, 3 + k % 2, 2 + k % 9, &random);
    const PottsSolution solution = minimise_potts(problem, random_labels(problem, &random), 50);
    for (ClassIndex target = 0; target < problem.classes; ++target) {
      ASSERT_LE(solution.energies.back(), lowest_after_move(problem, solution.labels, target));
    }
    ASSERT_LE(solution.energies.back(), 2 * lowest_energy(problem));
  }
}

TEST(AlphaExpansion, EnergyNeverRisesAndIsThatOfTheLabels) {
  std::mt19937 random(3);
  for (int k = 0; k < 50; ++k) {
    const PottsProblem problem = random_problem(60, 6, 1000, &random);
    const std::vector<ClassIndex> start = random_labels(problem, &random);
    const PottsSolution solution = minimise_potts(problem, start, 10);
    EXPECT_EQ(solution.energies.front(), potts_energy(problem, start));
    EXPECT_EQ(solution.energies.back(), potts_energy(problem, solution.labels));
    EXPECT_LT(solution.energies.back(), solution.energies.front());
    EXPECT_TRUE(std::is_sorted(solution.energies.rbegin(), solution.energies.rend()));
  }
}

TEST(AlphaExpansion, TiesKeepTheStart) {
  PottsProblem problem;
  problem.nodes = 4;
  problem.classes = 3;
  problem.unary.assign(12, 5);
  problem.edges = {{0, 1, 0}, {1, 2, 0}, {2, 3, 0}};
  const std::vector<ClassIndex> start{2, 0, 1, 2};
  EXPECT_EQ(minimise_potts(problem, start, 10).labels, start);
}

TEST(AlphaExpansion, WithoutEdgesEachNodeTakesItsBest) {
  std::mt19937 random(4);
  PottsProblem problem = random_problem(30, 4, 100, &random);
  problem.edges.clear();
  const PottsSolution solution = minimise_potts(problem, random_labels(problem, &random), 10);
  for (std::size_t node = 0; node < problem.nodes; ++node) {
    for (std::size_t label = 0; label < problem.classes; ++label) {
      EXPECT_LE(problem.cost(node, solution.labels[node]), problem.cost(node, label));
    }
  }
}

TEST(AlphaExpansion, NoSweepsMeansNoChange) {
  std::mt19937 random(5);
  const PottsProblem problem = random_problem(10, 3, 10, &random);
  const std::vector<ClassIndex> start = random_labels(problem, &random);
  EXPECT_EQ(minimise_potts(problem, start, 0).labels, start);
}

TEST(AlphaExpansion, InvalidProblemsAreRefused) {
  std::mt19937 random(6);
  const PottsProblem good = random_problem(4, 2, 9, &random);
  const std::vector<ClassIndex> start(4, 0);
  PottsProblem problem = good;
  problem.edges.push_back({0, 0, 1});
  EXPECT_THROW(minimise_potts(problem, start, 1), std::invalid_argument);
  problem = good;
  problem.edges.push_back({0, 9, 1});
  EXPECT_THROW(minimise_potts(problem, start, 1), std::invalid_argument);
  problem = good;
  problem.edges.push_back({0, 1, -1});
  EXPECT_THROW(minimise_potts(problem, start, 1), std::invalid_argument);
  problem = good;
  problem.unary.pop_back();
  EXPECT_THROW(minimise_potts(problem, start, 1), std::invalid_argument);
  EXPECT_THROW(minimise_potts(good, {0, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(minimise_potts(good, {0, 0, 0, 2}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
