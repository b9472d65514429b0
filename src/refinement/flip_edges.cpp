// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

#include "quality_steps.h"

namespace facet_mapping {
namespace {

class EdgeFlipper {
 public:
  explicit EdgeFlipper(QualityState* state)
      : state_(*state),
        editor_(state->editor),
        options_(state->options),
        bad_sin_(std::sin(options_.flip_deg * M_PI / 180.0)),
        waits_(editor_.mesh().triangles.size(), false) {}

  std::size_t run() {
    for (std::uint32_t f = 0; f < waits_.size(); ++f) {
      enqueue(f);
    }
    std::size_t done = 0;
    while (!queue_.empty()) {
      const std::uint32_t f = queue_.front();
      queue_.pop_front();
      waits_[f] = false;
      done += flip_worst_side(f) ? 1 : 0;
    }
    return done;
  }

 private:
  /// One flip of an edge and what it would bring.
  struct Flip {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    EdgeSides edge;
    double sin_angle = 0.0;  ///< the smaller one of the two facets afterwards
    double drift = 0.0;
  };

  void enqueue(std::uint32_t facet) {
    if (!waits_[facet] && editor_.is_alive(facet) && state_.shape(facet).sin_angle < bad_sin_) {
      waits_[facet] = true;
      queue_.push_back(facet);
    }
  }

  /// Flips the side of a facet that helps most.
  bool flip_worst_side(std::uint32_t facet) {
    const Triangle t = editor_.mesh().triangles[facet];
    std::optional<Flip> best;
    for (int side = 0; side < 3; ++side) {
      const std::optional<Flip> flip = check(t[side], t[(side + 1) % 3]);
      if (flip && (!best || flip->sin_angle > best->sin_angle)) {
        best = flip;
      }
    }
    if (!best) {
      return false;
    }
    const EdgeSides& edge = best->edge;
    editor_.flip(best->from, best->to, edge);
    for (const std::uint32_t f : edge.facets) {
      state_.drift[f] = best->drift;
    }
    for (const std::uint32_t v : {best->from, best->to, edge.left, edge.right}) {
      for (const std::uint32_t f : editor_.facets_of(v)) {
        enqueue(f);
      }
    }
    return true;
  }

  std::optional<Flip> check(std::uint32_t from, std::uint32_t to) const {
    const std::optional<EdgeSides> edge = editor_.sides(from, to);
    if (!edge || !state_.may_change(edge->facets[0]) || !state_.may_change(edge->facets[1]) ||
        !state_.same_region(edge->facets[0], edge->facets[1]) || !editor_.can_flip(*edge)) {
      return {};
    }
    Flip flip{from, to, *edge};
    return measure(&flip) ? std::optional<Flip>(flip) : std::nullopt;
  }

  /// False if the facets are not coplanar, would not be, move too far or gain too little.
  bool measure(Flip* flip) const {
    const EdgeSides& edge = flip->edge;
    const auto [f, g] = edge.facets;
    const std::array<FacetShape, 2> before = {state_.shape(f), state_.shape(g)};
    const std::array<FacetShape, 2> after = {
        state_.shape(Triangle{flip->from, edge.right, edge.left}),
        state_.shape(Triangle{flip->to, edge.left, edge.right})};
    flip->sin_angle = std::min(after[0].sin_angle, after[1].sin_angle);
    const double sin_before = std::min(before[0].sin_angle, before[1].sin_angle);
    if (flip->sin_angle <= options_.flip_gain * sin_before) {
      return false;
    }
    flip->drift = std::max(state_.drift[f], state_.drift[g]) + distance_of_diagonals(*flip);
    return are_coplanar(before, after) && flip->drift <= options_.max_drift * local_length(*flip);
  }

  bool are_coplanar(const std::array<FacetShape, 2>& before,
                    const std::array<FacetShape, 2>& after) const {
    // A sliver's own normal says nothing: then the other facet's has to do.
    constexpr double kSliverSin = 0.02;
    const bool use_second = before[0].sin_angle < before[1].sin_angle;
    const FacetShape& better = before[use_second ? 1 : 0];
    const FacetShape& worse = before[use_second ? 0 : 1];
    const bool coplanar =
        worse.sin_angle < kSliverSin || better.normal.dot(worse.normal) >= options_.flat_cos;
    return coplanar && better.normal.dot(after[0].normal) >= options_.flat_cos &&
           better.normal.dot(after[1].normal) >= options_.flat_cos;
  }

  /// Of the old and the new edge: where they pass each other the surface moves most.
  double distance_of_diagonals(const Flip& flip) const {
    const Eigen::Vector3d old_edge = editor_.point(flip.to) - editor_.point(flip.from);
    const Eigen::Vector3d new_edge = editor_.point(flip.edge.right) - editor_.point(flip.edge.left);
    const Eigen::Vector3d across = editor_.point(flip.edge.left) - editor_.point(flip.from);
    return std::abs(old_edge.cross(new_edge).normalized().dot(across));
  }

  double local_length(const Flip& flip) const {
    const std::vector<double>& length = state_.local_length;
    return std::min(
        {length[flip.from], length[flip.to], length[flip.edge.left], length[flip.edge.right]});
  }

  QualityState& state_;
  MeshEditor& editor_;
  const QualityOptions& options_;
  double bad_sin_;
  std::vector<bool> waits_;
  std::deque<std::uint32_t> queue_;
};

}  // namespace

std::size_t flip_edges(QualityState* state) {
  return EdgeFlipper(state).run();
}

}  // namespace facet_mapping
