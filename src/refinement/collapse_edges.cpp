// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "quality_steps.h"

#include "facet_mapping/geometry/segment.h"

namespace facet_mapping {
namespace {

Triangle merged(Triangle t, std::uint32_t from, std::uint32_t to) {
  std::replace(t.begin(), t.end(), from, to);
  return t;
}

/// What one collapse would do.
struct Collapse {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  EdgeSides edge;
  double sin_angle = 1.0;  ///< the smallest afterwards around `from`
  double drift = 0.0;      ///< the largest afterwards of those facets
};

class EdgeCollapser {
 public:
  explicit EdgeCollapser(QualityState* state)
      : state_(*state),
        editor_(state->editor),
        options_(state->options),
        needle_sin_(std::sin(options_.needle_deg * M_PI / 180.0)) {}

  std::size_t run() {
    std::size_t done = 0;
    for (const auto& [ratio, edge] : candidates()) {
      done += try_collapse(edge) ? 1 : 0;
    }
    return done;
  }

 private:
  using Candidate = std::pair<double, EdgeKey>;

  /// Short edges and the shortest edges of needles; relative lengths, ascending.
  std::vector<Candidate> candidates() const {
    std::vector<Candidate> found;
    for (std::uint32_t f = 0; f < editor_.mesh().triangles.size(); ++f) {
      if (!editor_.is_alive(f)) {
        continue;
      }
      const Triangle& t = editor_.mesh().triangles[f];
      std::array<Candidate, 3> edges;
      for (int side = 0; side < 3; ++side) {
        const EdgeKey key = std::minmax(t[side], t[(side + 1) % 3]);
        edges[side] = {relative_length(key), key};
      }
      std::sort(edges.begin(), edges.end());
      const bool is_needle = state_.shape(f).sin_angle < needle_sin_;
      for (int k = 0; k < 3; ++k) {
        if (edges[k].first < options_.short_edge || (k == 0 && is_needle)) {
          found.push_back(edges[k]);
        }
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  double relative_length(const EdgeKey& edge) const {
    const auto [a, b] = edge;
    const double surroundings = 0.5 * (state_.local_length[a] + state_.local_length[b]);
    return (editor_.point(a) - editor_.point(b)).norm() / surroundings;
  }

  bool try_collapse(const EdgeKey& edge) {
    const std::optional<Collapse> there = check(edge.first, edge.second);
    const std::optional<Collapse> back = check(edge.second, edge.first);
    if (!there && !back) {
      return false;
    }
    const bool use_there = there && (!back || there->sin_angle >= back->sin_angle);
    const Collapse& best = use_there ? *there : *back;
    for (const std::uint32_t f : editor_.facets_of(best.from)) {
      state_.drift[f] = best.drift;
    }
    editor_.collapse(best.from, best.to, best.edge);
    return true;
  }

  std::optional<Collapse> check(std::uint32_t from, std::uint32_t to) const {
    const std::optional<EdgeSides> edge = editor_.sides(from, to);
    if (!edge || !is_wanted(from, to, *edge) || !may_move(from) ||
        !editor_.can_collapse(from, to, *edge)) {
      return {};
    }
    Collapse collapse{from, to, *edge};
    const std::optional<double> border_move = move_of_border(collapse);
    if (!border_move || !measure(*border_move, &collapse)) {
      return {};
    }
    return collapse;
  }

  bool may_move(std::uint32_t vertex) const {
    const std::vector<std::uint32_t>& star = editor_.facets_of(vertex);
    return std::all_of(
        star.begin(), star.end(), [this](std::uint32_t f) { return state_.may_change(f); });
  }

  /// Earlier collapses may have made a needle vanish.
  bool is_wanted(std::uint32_t from, std::uint32_t to, const EdgeSides& edge) const {
    return relative_length(std::minmax(from, to)) < options_.short_edge ||
           state_.shape(edge.facets[0]).sin_angle < needle_sin_ ||
           state_.shape(edge.facets[1]).sin_angle < needle_sin_;
  }

  /// How far the border of regions through `from` would move; nothing if it ends or branches there
  /// or does not run along the edge.
  std::optional<double> move_of_border(const Collapse& collapse) const {
    const std::uint32_t from = collapse.from;
    const std::vector<std::uint32_t>& star = editor_.facets_of(from);
    if (std::all_of(star.begin(), star.end(), [&](std::uint32_t f) {
          return state_.same_region(f, star[0]);
        })) {
      return 0.0;
    }
    if (state_.same_region(collapse.edge.facets[0], collapse.edge.facets[1])) {
      return {};
    }
    std::optional<double> move;
    for (const std::uint32_t f : star) {
      const std::uint32_t next = editor_.next_around(f, from);
      const std::optional<EdgeSides> spoke = editor_.sides(from, next);
      if (next == collapse.to || !spoke || state_.same_region(spoke->facets[0], spoke->facets[1])) {
        continue;
      }
      if (move) {
        return {};
      }
      move =
          distance_to_segment(editor_.point(from), editor_.point(collapse.to), editor_.point(next));
    }
    return move;
  }

  /// False if the facets around `from` would turn, become worse or move too far.
  bool measure(double border_move, Collapse* collapse) const {
    const auto [from, to] = std::make_pair(collapse->from, collapse->to);
    double worst_before = 1.0;
    double drift_before = 0.0;
    double move = border_move;
    for (const std::uint32_t f : editor_.facets_of(from)) {
      const Triangle& t = editor_.mesh().triangles[f];
      const FacetShape before = state_.shape(f);
      worst_before = std::min(worst_before, before.sin_angle);
      drift_before = std::max(drift_before, state_.drift[f]);
      if (f == collapse->edge.facets[0] || f == collapse->edge.facets[1]) {
        continue;
      }
      const FacetShape after = state_.shape(merged(t, from, to));
      if (before.normal.dot(after.normal) < options_.turn_cos) {
        return false;
      }
      collapse->sin_angle = std::min(collapse->sin_angle, after.sin_angle);
      move = std::max(move, std::abs(before.normal.dot(editor_.point(to) - editor_.point(from))));
    }
    collapse->drift = drift_before + move;
    const double limit =
        options_.max_drift * std::min(state_.local_length[from], state_.local_length[to]);
    return collapse->sin_angle > worst_before && collapse->drift <= limit;
  }

  QualityState& state_;
  MeshEditor& editor_;
  const QualityOptions& options_;
  double needle_sin_;
};

}  // namespace

std::size_t collapse_edges(QualityState* state) {
  return EdgeCollapser(state).run();
}

}  // namespace facet_mapping
