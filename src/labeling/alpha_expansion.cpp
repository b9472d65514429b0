// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labeling/alpha_expansion.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include <opencv2/core.hpp>
// After core.hpp, which it needs.
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace facet_mapping {
namespace {

using Cut = cv::detail::GCGraph<std::int64_t>;

/// The move to one class: which nodes should change to it?
class Expansion {
 public:
  Expansion(const PottsProblem& problem, const std::vector<ClassIndex>& labels, ClassIndex target);

  /// The labelling after the best move.
  std::vector<ClassIndex> best_move();

 private:
  bool is_free(std::uint32_t node) const { return labels_[node] != target_; }
  void add_edge(const PottsEdge& edge);

  const PottsProblem& problem_;
  const std::vector<ClassIndex>& labels_;
  ClassIndex target_;
  std::int64_t scale_;              // of the costs in the graph, see add_nodes
  std::vector<int> vertex_;         // node -> vertex of the graph, -1 if it has the class already
  std::vector<std::int64_t> gain_;  // per vertex: cost of changing minus cost of keeping
  Cut cut_;
  bool has_edges_ = false;
};

Expansion::Expansion(const PottsProblem& problem,
                     const std::vector<ClassIndex>& labels,
                     ClassIndex target)
    : problem_(problem),
      labels_(labels),
      target_(target),
      scale_(static_cast<std::int64_t>(problem.nodes) + 1),
      vertex_(problem.nodes, -1) {
  for (std::uint32_t node = 0; node < problem.nodes; ++node) {
    if (is_free(node)) {
      vertex_[node] = static_cast<int>(gain_.size());
      // Each change costs one part in (nodes + 1) of a cost unit: less than a unit in all, so the
      // best energy stays the best, but among equals the fewest changes win. The minimum cut is
      // then unique, which GCGraph needs: it leaves vertices that ties set free on a random side.
      gain_.push_back(
          scale_ * (problem.cost(node, target) - std::int64_t{problem.cost(node, labels[node])}) +
          1);
    }
  }
  cut_.create(static_cast<unsigned>(gain_.size()), static_cast<unsigned>(2 * problem.edges.size()));
  for (std::size_t v = 0; v < gain_.size(); ++v) {
    cut_.addVtx();
  }
  for (const PottsEdge& edge : problem.edges) {
    add_edge(edge);
  }
}

// Source side = keeps its class, sink side = changes to the target.
void Expansion::add_edge(const PottsEdge& edge) {
  const int a = vertex_[edge.a];
  const int b = vertex_[edge.b];
  const std::int64_t weight = scale_ * edge.weight;
  if (weight == 0 || (a < 0 && b < 0)) {
    return;
  }
  if (a < 0 || b < 0) {
    gain_[static_cast<std::size_t>(std::max(a, b))] -= weight;
  } else if (labels_[edge.a] == labels_[edge.b]) {
    cut_.addEdges(a, b, weight, weight);
    has_edges_ = true;
  } else {
    // Paid unless both change: paid if b keeps, and if a keeps while b changes.
    gain_[static_cast<std::size_t>(b)] -= weight;
    cut_.addEdges(a, b, weight, 0);
    has_edges_ = true;
  }
}

std::vector<ClassIndex> Expansion::best_move() {
  std::vector<ClassIndex> moved = labels_;
  for (std::size_t v = 0; v < gain_.size(); ++v) {
    cut_.addTermWeights(static_cast<int>(v),
                        std::max<std::int64_t>(gain_[v], 0),
                        std::max<std::int64_t>(-gain_[v], 0));
  }
  if (has_edges_) {
    cut_.maxFlow();
  }
  for (std::size_t node = 0; node < moved.size(); ++node) {
    const int v = vertex_[node];
    if (v >= 0) {
      const bool keeps =
          has_edges_ ? cut_.inSourceSegment(v) : gain_[static_cast<std::size_t>(v)] >= 0;
      moved[node] = keeps ? moved[node] : target_;
    }
  }
  return moved;
}

void check_start(const PottsProblem& problem, const std::vector<ClassIndex>& start) {
  if (start.size() != problem.nodes) {
    throw std::invalid_argument("alpha-expansion: give one start class per node");
  }
  for (const ClassIndex label : start) {
    if (label >= problem.classes) {
      throw std::invalid_argument("alpha-expansion: start class " + std::to_string(label) +
                                  " of only " + std::to_string(problem.classes));
    }
  }
}

}  // namespace

void validate(const PottsProblem& problem) {
  constexpr std::size_t kMostNodes = 1U << 28U;  // the graph counts vertices and edges in int
  if (problem.classes == 0 || problem.unary.size() != problem.nodes * problem.classes) {
    throw std::invalid_argument("alpha-expansion: give one cost per node and class");
  }
  if (problem.nodes > kMostNodes || problem.edges.size() > kMostNodes) {
    throw std::invalid_argument("alpha-expansion: more than 2^28 nodes or edges");
  }
  for (const PottsEdge& edge : problem.edges) {
    if (edge.a == edge.b || edge.a >= problem.nodes || edge.b >= problem.nodes || edge.weight < 0) {
      throw std::invalid_argument("alpha-expansion: edge " + std::to_string(edge.a) + "-" +
                                  std::to_string(edge.b) + " is no edge of the graph or negative");
    }
  }
}

std::int64_t potts_energy(const PottsProblem& problem, const std::vector<ClassIndex>& labels) {
  std::int64_t energy = 0;
  for (std::size_t node = 0; node < problem.nodes; ++node) {
    energy += problem.cost(node, labels[node]);
  }
  for (const PottsEdge& edge : problem.edges) {
    energy += labels[edge.a] == labels[edge.b] ? 0 : edge.weight;
  }
  return energy;
}

PottsSolution minimise_potts(const PottsProblem& problem,
                             const std::vector<ClassIndex>& start,
                             int max_sweeps) {
  validate(problem);
  check_start(problem, start);
  PottsSolution solution{start, {potts_energy(problem, start)}};
  std::size_t idle = 0;  // moves in a row that changed nothing
  const std::size_t most_moves =
      problem.classes * static_cast<std::size_t>(std::max(max_sweeps, 0));
  for (std::size_t move = 0; move < most_moves && idle < problem.classes; ++move) {
    const auto target = static_cast<ClassIndex>(move % problem.classes);
    std::vector<ClassIndex> moved = Expansion(problem, solution.labels, target).best_move();
    const std::int64_t energy = potts_energy(problem, moved);
    ++idle;
    if (energy < solution.energies.back()) {
      solution.labels = std::move(moved);
      idle = 1;
    }
    solution.energies.push_back(std::min(energy, solution.energies.back()));
  }
  return solution;
}

}  // namespace facet_mapping
