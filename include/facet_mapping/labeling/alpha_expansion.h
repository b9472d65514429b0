// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimisation of a Potts energy by alpha-expansion (Boykov, Veksler, Zabih 2001): each move lets
// any set of nodes change to one class and finds the best such set by a minimum cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facet_mapping {

/// Costs are whole numbers of 1/kCostUnit nats (-log of a probability), so that sums are exact and
/// neither the order of summation nor the number of threads matters.
constexpr double kCostUnit = 16384.0;

/// Index into the list of classes that are tried.
using ClassIndex = std::uint16_t;

/// `weight` is paid if the classes of `a` and `b` differ.
struct PottsEdge {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::int32_t weight = 0;
};

struct PottsProblem {
  std::size_t nodes = 0;
  std::size_t classes = 0;
  std::vector<std::int32_t> unary;  ///< nodes rows of `classes` costs
  std::vector<PottsEdge> edges;

  std::int32_t cost(std::size_t node, std::size_t label) const {
    return unary[node * classes + label];
  }
};

/// Throws std::invalid_argument if there is no class, `unary` has the wrong length or an edge joins
/// a node to itself, names a node that is not there or has a negative weight.
void validate(const PottsProblem& problem);

/// The energy of a labelling, in cost units.
std::int64_t potts_energy(const PottsProblem& problem, const std::vector<ClassIndex>& labels);

struct PottsSolution {
  std::vector<ClassIndex> labels;      ///< one per node
  std::vector<std::int64_t> energies;  ///< of the start and after each move; never rising
};

/// Improves `start` by moves to class 0, 1, 2, ... in turn until none of them lowers the energy or
/// each class has had `max_sweeps` turns. The energy is at most twice the lowest plus what the
/// unary costs share; with two classes it is the lowest. Nodes keep their class unless the energy
/// falls. Throws std::invalid_argument on an invalid problem or start.
PottsSolution minimise_potts(const PottsProblem& problem,
                             const std::vector<ClassIndex>& start,
                             int max_sweeps);

}  // namespace facet_mapping
