// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/facet_field.h"

#include <algorithm>
#include <cmath>

#include "labeling/orientation_prior.h"
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

constexpr std::size_t kGrain = 8192;

template <typename Body>
void for_each_facet(std::size_t facets, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, facets, kGrain), [&](const auto& range) {
    for (std::size_t f = range.begin(); f < range.end(); ++f) {
      body(f);
    }
  });
}

std::int32_t in_units(double nats) {
  return static_cast<std::int32_t>(std::lround(kCostUnit * nats));
}

std::vector<ClassIndex> own_classes(const TriangleMesh& mesh, const Votes& votes) {
  std::vector<ClassIndex> own(mesh.triangles.size(), kNoClass);
  for (std::size_t f = 0; f < mesh.labels.size(); ++f) {
    own[f] = votes.index_of(mesh.labels[f]);
  }
  return own;
}

bool supports_any(const std::vector<double>& shares) {
  return std::any_of(shares.begin(), shares.end(), [](double share) { return share > 0.0; });
}

/// The class with the most evidence, by facet; where there is none, the facet's own.
std::vector<ClassIndex> best_by_data(const TriangleMesh& mesh,
                                     const Votes& votes,
                                     const std::vector<ClassIndex>& own) {
  std::vector<ClassIndex> best = own;
  for_each_facet(mesh.triangles.size(), [&](std::size_t f) {
    const std::vector<double> shares = votes.shares(f, mesh.triangles[f]);
    if (supports_any(shares)) {
      best[f] =
          static_cast<ClassIndex>(std::max_element(shares.begin(), shares.end()) - shares.begin());
    }
  });
  return best;
}

void fill_unary(const TriangleMesh& mesh,
                const Votes& votes,
                const OrientationModel& orientation,
                const std::vector<Eigen::Vector3d>& normals,
                const LabelingConfig& config,
                FacetField* field) {
  const std::size_t classes = votes.classes.size();
  field->problem.unary.resize(mesh.triangles.size() * classes);
  for_each_facet(mesh.triangles.size(), [&](std::size_t f) {
    const std::vector<double> shares = votes.shares(f, mesh.triangles[f]);
    const bool seen = supports_any(shares);
    for (std::size_t k = 0; k < classes; ++k) {
      double cost = config.normal_weight * orientation_cost(orientation, f, normals[f], k, config);
      if (seen) {
        cost -= std::log(std::max(config.beta, shares[k]));
      } else if (field->own[f] != kNoClass && field->own[f] != k) {
        cost += config.own_label_weight;
      }
      field->problem.unary[f * classes + k] = in_units(cost);
    }
  });
}

/// Facets that no evidence reaches have no edge to others; without costs they change nothing.
void clear_unreached(FacetField* field) {
  const std::size_t classes = field->problem.classes;
  for (std::size_t f = 0; f < field->start.size(); ++f) {
    if (field->start[f] == kNoClass) {
      std::fill_n(field->problem.unary.begin() + static_cast<std::ptrdiff_t>(f * classes),
                  classes,
                  std::int32_t{0});
    }
  }
}

}  // namespace

FacetField make_field(const TriangleMesh& mesh,
                      const Votes& votes,
                      const FacetGraph& graph,
                      const LabelingConfig& config) {
  FacetField field;
  field.own = own_classes(mesh, votes);
  field.start = best_by_data(mesh, votes, field.own);
  std::vector<Eigen::Vector3d> normals(mesh.triangles.size());
  for_each_facet(normals.size(), [&](std::size_t f) { normals[f] = facet_cross(mesh, f); });
  const ClassFacets facets(normals, field.own, field.start, votes.classes.size(), config);
  fill_unary(mesh, votes, *make_orientation_model(facets, graph, config), normals, config, &field);
  field.problem.nodes = mesh.triangles.size();
  field.problem.classes = votes.classes.size();
  field.problem.edges = graph.edges;
  field.evident.resize(field.start.size());
  std::transform(field.start.begin(), field.start.end(), field.evident.begin(), [](ClassIndex c) {
    return c != kNoClass;
  });
  spread_classes(graph, &field.start);
  clear_unreached(&field);
  return field;
}

std::vector<float> label_margins(const FacetField& field,
                                 const FacetGraph& graph,
                                 const std::vector<ClassIndex>& labels) {
  const PottsProblem& problem = field.problem;
  std::vector<float> margins(problem.nodes, 0.0F);
  for_each_facet(problem.nodes, [&](std::size_t f) {
    std::vector<double> cost(problem.classes, 0.0);
    bool informed = field.evident[f];
    for (std::size_t k = 0; k < problem.classes; ++k) {
      cost[k] = problem.cost(f, k);
    }
    for (const std::int32_t edge : graph.edges_of[f]) {
      if (edge < 0 || !field.evident[graph.other(edge, static_cast<std::uint32_t>(f))]) {
        continue;
      }
      informed = true;
      // A neighbour's support for its class, written as a discount: the same up to a constant.
      const std::uint32_t other = graph.other(edge, static_cast<std::uint32_t>(f));
      cost[labels[other]] -= graph.edges[static_cast<std::size_t>(edge)].weight;
    }
    if (!informed || labels[f] == kNoClass) {
      return;
    }
    double sum = 0.0;
    double second = 0.0;
    for (std::size_t k = 0; k < problem.classes; ++k) {
      const double relative = std::exp((cost[labels[f]] - cost[k]) / kCostUnit);
      sum += relative;
      second = k == labels[f] ? second : std::max(second, relative);
    }
    margins[f] = static_cast<float>(std::max(0.0, (1.0 - second) / sum));
  });
  return margins;
}

}  // namespace facet_mapping
