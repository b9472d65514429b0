// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/vertex_votes.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "facet_mapping/render/visibility.h"

namespace facet_mapping {
namespace {

constexpr std::size_t kGrain = 8192;

/// Column of each label in the count matrix; -1 for labels that are void.
class Columns {
 public:
  Columns(const TriangleMesh& mesh,
          const std::vector<LabeledView>& views,
          const std::vector<Label>& excluded) {
    std::vector<bool> present(kUnlabelled + std::size_t{1}, false);
    for (const Label label : mesh.labels) {
      present[label] = true;
    }
    for (const LabeledView& view : views) {
      for (int y = 0; y < view.labels.rows; ++y) {
        const auto* row = view.labels.ptr<Label>(y);
        for (int x = 0; x < view.labels.cols; ++x) {
          present[row[x]] = true;
        }
      }
    }
    present[kUnlabelled] = false;
    for (const Label label : excluded) {
      present[label] = false;
    }
    for (std::size_t label = 0; label < present.size(); ++label) {
      if (present[label]) {
        column_[label] = static_cast<int>(labels_.size());
        labels_.push_back(static_cast<Label>(label));
      }
    }
  }

  int of(Label label) const { return column_[label]; }
  const std::vector<Label>& labels() const { return labels_; }

 private:
  std::vector<int> column_ = std::vector<int>(kUnlabelled + std::size_t{1}, -1);
  std::vector<Label> labels_;
};

/// Votes of one view; the caller goes through the views in order.
void add_view(const TriangleMesh& mesh,
              const LabeledView& view,
              const VisibilityTest& visibility,
              const Columns& columns,
              VertexVotes* votes) {
  const std::size_t width = columns.labels().size();
  std::vector<std::uint8_t> sees(mesh.vertices.size(), 0);
  const auto vote = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      const auto pixel = visibility.pixel(mesh.vertices[v]);
      const int column = pixel ? columns.of(view.labels.at<Label>(*pixel)) : -1;
      if (column >= 0) {
        ++votes->counts[v * width + static_cast<std::size_t>(column)];
        ++votes->seen[v];
        sees[v] = 1;
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sees.size(), kGrain), vote);
  const auto mark = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t f = range.begin(); f < range.end(); ++f) {
      const Triangle& t = mesh.triangles[f];
      votes->facet_views[f] += (sees[t[0]] | sees[t[1]] | sees[t[2]]) != 0 ? 1 : 0;
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kGrain), mark);
}

/// What a class's place in the order follows from: never its number, unless all else is equal.
struct Evidence {
  std::size_t votes = 0;
  std::size_t facets = 0;
  std::size_t first_vertex = std::numeric_limits<std::size_t>::max();
  std::size_t first_facet = std::numeric_limits<std::size_t>::max();
  std::size_t column = 0;

  bool operator<(const Evidence& other) const {
    return std::tie(other.votes, other.facets, first_vertex, first_facet, column) <
           std::tie(votes, facets, other.first_vertex, other.first_facet, other.column);
  }
};

std::vector<Evidence> rank(const TriangleMesh& mesh,
                           const VertexVotes& votes,
                           const Columns& columns) {
  const std::size_t width = columns.labels().size();
  std::vector<Evidence> evidence(width);
  for (std::size_t k = 0; k < votes.counts.size(); ++k) {
    if (votes.counts[k] > 0) {
      Evidence& e = evidence[k % width];
      e.votes += votes.counts[k];
      e.first_vertex = std::min(e.first_vertex, k / width);
    }
  }
  for (std::size_t f = 0; f < mesh.labels.size(); ++f) {
    const int column = columns.of(mesh.labels[f]);
    if (column >= 0) {
      Evidence& e = evidence[static_cast<std::size_t>(column)];
      ++e.facets;
      e.first_facet = std::min(e.first_facet, f);
    }
  }
  for (std::size_t k = 0; k < width; ++k) {
    evidence[k].column = k;
  }
  evidence.erase(std::remove_if(evidence.begin(),
                                evidence.end(),
                                [](const Evidence& e) { return e.votes == 0 && e.facets == 0; }),
                 evidence.end());
  std::sort(evidence.begin(), evidence.end());
  return evidence;
}

/// Brings the counts into the order of the ranking and drops the classes that are not in it.
void reorder(const std::vector<Evidence>& ranking, const Columns& columns, VertexVotes* votes) {
  const std::size_t width = columns.labels().size();
  std::vector<std::uint16_t> counts(votes->seen.size() * ranking.size());
  for (std::size_t v = 0; v < votes->seen.size(); ++v) {
    for (std::size_t k = 0; k < ranking.size(); ++k) {
      counts[v * ranking.size() + k] = votes->counts[v * width + ranking[k].column];
    }
  }
  votes->counts = std::move(counts);
  for (const Evidence& e : ranking) {
    votes->classes.push_back(columns.labels()[e.column]);
  }
}

}  // namespace

ClassIndex VertexVotes::index_of(Label label) const {
  const auto found = std::find(classes.begin(), classes.end(), label);
  return found == classes.end() ? kNoClass : static_cast<ClassIndex>(found - classes.begin());
}

VertexVotes count_votes(const TriangleMesh& mesh,
                        const std::vector<LabeledView>& views,
                        const std::vector<FacetImage>& renderings,
                        const LabelingConfig& config) {
  const Columns columns(mesh, views, config.excluded);
  VertexVotes votes;
  votes.counts.assign(mesh.vertices.size() * columns.labels().size(), 0);
  votes.seen.assign(mesh.vertices.size(), 0);
  votes.facet_views.assign(mesh.triangles.size(), 0);
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (!views[k].labels.empty()) {
      const VisibilityTest visibility(views[k].view, renderings[k].depth, config.depth_tolerance);
      add_view(mesh, views[k], visibility, columns, &votes);
    }
  }
  reorder(rank(mesh, votes, columns), columns, &votes);
  return votes;
}

}  // namespace facet_mapping
