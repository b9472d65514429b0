// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/votes.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "facet_mapping/render/visibility.h"

namespace facet_mapping {
namespace {

constexpr std::size_t kGrain = 8192;

constexpr int kVoid = -1;      ///< says nothing: as if the image did not see the place
constexpr int kExcluded = -2;  ///< sees the place, but supports no class

/// Column of each label in the count matrix, kVoid or kExcluded.
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
      column_[label] = label == kUnlabelled ? kVoid : kExcluded;
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
  std::vector<int> column_ = std::vector<int>(kUnlabelled + std::size_t{1}, kVoid);
  std::vector<Label> labels_;
};

using Flags = std::vector<std::uint8_t>;

/// One view's votes for the vertices; marks those that it sees.
void add_vertices(const TriangleMesh& mesh,
                  const LabeledView& view,
                  const VisibilityTest& visibility,
                  const Columns& columns,
                  Votes* votes,
                  Flags* sees) {
  const std::size_t width = columns.labels().size();
  const auto vote = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      const auto pixel = visibility.pixel(mesh.vertices[v]);
      const int column = pixel ? columns.of(view.labels.at<Label>(*pixel)) : kVoid;
      if (column == kVoid) {
        continue;
      }
      (*sees)[v] = 1;
      ++votes->vertex_views[v];
      if (column >= 0) {
        ++votes->vertex[v * width + static_cast<std::size_t>(column)];
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sees->size(), kGrain), vote);
}

/// One view's votes for the facets by the pixels that show them; marks those that it sees.
void add_pixels(const LabeledView& view,
                const FacetImage& rendering,
                const std::vector<std::int32_t>& facet_of,
                const Columns& columns,
                Votes* votes,
                Flags* sees) {
  const std::size_t width = columns.labels().size();
  for (int y = 0; y < view.labels.rows; ++y) {
    const auto* labels = view.labels.ptr<Label>(y);
    const auto* facets = rendering.facets.ptr<std::int32_t>(y);
    for (int x = 0; x < view.labels.cols; ++x) {
      const int column = columns.of(labels[x]);
      const std::int32_t facet =
          facets[x] < 0 ? kNotObserved : facet_of[static_cast<std::size_t>(facets[x])];
      if (facet == kNotObserved || column == kVoid) {
        continue;
      }
      const auto f = static_cast<std::size_t>(facet);
      (*sees)[f] = 1;
      ++votes->pixels[f];
      if (column >= 0) {
        ++votes->pixel[f * width + static_cast<std::size_t>(column)];
      }
    }
  }
}

/// Votes of one view; the caller goes through the views in order.
void add_view(const TriangleMesh& mesh,
              const LabeledView& view,
              const FacetImage& rendering,
              const std::vector<std::int32_t>& facet_of,
              const Columns& columns,
              const LabelingConfig& config,
              Votes* votes) {
  const VisibilityTest visibility(view.view, rendering.depth, config.depth_tolerance);
  Flags sees_vertex(mesh.vertices.size(), 0);
  Flags sees_facet(mesh.triangles.size(), 0);
  add_vertices(mesh, view, visibility, columns, votes, &sees_vertex);
  if (config.pixel_votes) {
    add_pixels(view, rendering, facet_of, columns, votes, &sees_facet);
  }
  const auto mark = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t f = range.begin(); f < range.end(); ++f) {
      const Triangle& t = mesh.triangles[f];
      const int seen = sees_facet[f] | sees_vertex[t[0]] | sees_vertex[t[1]] | sees_vertex[t[2]];
      votes->facet_views[f] += seen != 0 ? 1 : 0;
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kGrain), mark);
}

/// What a class's place in the order follows from: never its number, unless all else is equal.
struct Evidence {
  std::size_t votes = 0;
  std::size_t facets = 0;
  std::size_t first_vote = std::numeric_limits<std::size_t>::max();
  std::size_t first_facet = std::numeric_limits<std::size_t>::max();
  std::size_t column = 0;

  bool operator<(const Evidence& other) const {
    return std::tie(other.votes, other.facets, first_vote, first_facet, column) <
           std::tie(votes, facets, other.first_vote, other.first_facet, other.column);
  }
};

/// Adds a count matrix to the evidence of its columns.
template <typename Count>
void add_counts(const std::vector<Count>& counts, std::vector<Evidence>* evidence) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] > 0) {
      Evidence& e = (*evidence)[k % evidence->size()];
      e.votes += counts[k];
      e.first_vote = std::min(e.first_vote, k / evidence->size());
    }
  }
}

std::vector<Evidence> rank(const TriangleMesh& mesh, const Votes& votes, const Columns& columns) {
  std::vector<Evidence> evidence(columns.labels().size());
  add_counts(votes.vertex, &evidence);
  add_counts(votes.pixel, &evidence);
  for (std::size_t f = 0; f < mesh.labels.size(); ++f) {
    const int column = columns.of(mesh.labels[f]);
    if (column >= 0) {
      Evidence& e = evidence[static_cast<std::size_t>(column)];
      ++e.facets;
      e.first_facet = std::min(e.first_facet, f);
    }
  }
  for (std::size_t k = 0; k < evidence.size(); ++k) {
    evidence[k].column = k;
  }
  const auto absent = [](const Evidence& e) { return e.votes == 0 && e.facets == 0; };
  evidence.erase(std::remove_if(evidence.begin(), evidence.end(), absent), evidence.end());
  std::sort(evidence.begin(), evidence.end());
  return evidence;
}

/// Brings a count matrix into the order of the ranking and drops the classes that are not in it.
template <typename Count>
void reorder(const std::vector<Evidence>& ranking, std::size_t width, std::vector<Count>* counts) {
  if (width == 0) {
    return;
  }
  std::vector<Count> ordered(counts->size() / width * ranking.size());
  for (std::size_t row = 0; row < counts->size() / width; ++row) {
    for (std::size_t k = 0; k < ranking.size(); ++k) {
      ordered[row * ranking.size() + k] = (*counts)[row * width + ranking[k].column];
    }
  }
  *counts = std::move(ordered);
}

}  // namespace

double Votes::share(std::size_t facet, const Triangle& corners, std::size_t index) const {
  const double by_vertices = (vertex_share(corners[0], index) + vertex_share(corners[1], index) +
                              vertex_share(corners[2], index)) /
                             3.0;
  if (pixels[facet] == 0) {
    return by_vertices;
  }
  return (pixel[facet * classes.size() + index] + kVertexPixels * by_vertices) /
         (pixels[facet] + kVertexPixels);
}

std::vector<double> Votes::shares(std::size_t facet, const Triangle& corners) const {
  std::vector<double> shares(classes.size());
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k] = share(facet, corners, k);
  }
  return shares;
}

ClassIndex Votes::index_of(Label label) const {
  const auto found = std::find(classes.begin(), classes.end(), label);
  return found == classes.end() ? kNoClass : static_cast<ClassIndex>(found - classes.begin());
}

Votes count_votes(const TriangleMesh& mesh,
                  const std::vector<LabeledView>& views,
                  const std::vector<FacetImage>& renderings,
                  const std::vector<std::int32_t>& facet_of,
                  const LabelingConfig& config) {
  const Columns columns(mesh, views, config.excluded);
  const std::size_t width = columns.labels().size();
  Votes votes;
  votes.vertex.assign(mesh.vertices.size() * width, 0);
  votes.vertex_views.assign(mesh.vertices.size(), 0);
  votes.pixel.assign(config.pixel_votes ? mesh.triangles.size() * width : 0, 0);
  votes.pixels.assign(mesh.triangles.size(), 0);
  votes.facet_views.assign(mesh.triangles.size(), 0);
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (!views[k].labels.empty()) {
      add_view(mesh, views[k], renderings[k], facet_of, columns, config, &votes);
    }
  }
  const std::vector<Evidence> ranking = rank(mesh, votes, columns);
  reorder(ranking, width, &votes.vertex);
  reorder(ranking, width, &votes.pixel);
  for (const Evidence& e : ranking) {
    votes.classes.push_back(columns.labels()[e.column]);
  }
  return votes;
}

}  // namespace facet_mapping
