// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labeling/facet_labeling.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "labeling/facet_field.h"
#include "labeling/facet_graph.h"
#include "labeling/votes.h"

#include "facet_mapping/labeling/alpha_expansion.h"
#include "facet_mapping/render/observed_mesh.h"

namespace facet_mapping {
namespace {

void require(bool condition, const std::string& sentence) {
  if (!condition) {
    throw std::invalid_argument("labelling: " + sentence);
  }
}

void check_config(const LabelingConfig& c) {
  require(c.beta > 0.0 && c.beta <= 1.0, "beta must lie in (0, 1]");
  require(c.normal_weight >= 0.0 && c.normal_weight <= 1000.0,
          "normal_weight must lie in [0, 1000]");
  require(c.normal_floor > 0.0 && c.normal_floor <= 1.0, "normal_floor must lie in (0, 1]");
  require(c.min_normal_sigma_deg > 0.0 && c.min_normal_sigma_deg <= 180.0,
          "min_normal_sigma_deg must lie in (0, 180]");
  require(c.local_facets >= 1 && c.local_facets <= 1000000,
          "local_facets must lie in [1, 1000000]");
  require(c.smooth_different > 0.0 && c.smooth_equal <= 1.0 && c.smooth_different <= c.smooth_equal,
          "0 < smooth_different <= smooth_equal <= 1 must hold");
  require(c.own_label_weight >= 0.0 && c.own_label_weight <= 1000.0,
          "own_label_weight must lie in [0, 1000]");
  require(c.max_sweeps >= 0, "max_sweeps must not be negative");
}

void check_views(const TriangleMesh& mesh,
                 const std::vector<LabeledView>& views,
                 const std::vector<FacetImage>& renderings) {
  require(views.size() == renderings.size(),
          "give one rendering per view, not " + std::to_string(renderings.size()) + " for " +
              std::to_string(views.size()));
  for (std::size_t k = 0; k < views.size(); ++k) {
    const cv::Mat& labels = views[k].labels;
    if (labels.empty()) {
      continue;
    }
    const cv::Size size(views[k].view.camera.width, views[k].view.camera.height);
    require(
        labels.type() == CV_16UC1 && labels.size() == size,
        "the segmentation of view " + std::to_string(k) + " must be CV_16UC1 of the camera's size");
    require(renderings[k].depth.size() == size && renderings[k].facets.size() == size &&
                renderings[k].facets.type() == CV_32SC1,
            "the rendering of view " + std::to_string(k) + " does not have the camera's size");
    double largest = -1.0;
    cv::minMaxLoc(renderings[k].facets, nullptr, &largest);
    require(largest < static_cast<double>(mesh.triangles.size()),
            "the rendering of view " + std::to_string(k) + " shows another mesh");
  }
}

/// Nothing to decide: no class occurs anywhere.
LabelingResult unlabelled(const TriangleMesh& mesh) {
  LabelingResult result;
  result.labels.assign(mesh.triangles.size(), kUnlabelled);
  result.confidence.assign(mesh.triangles.size(), 0.0F);
  result.views.assign(mesh.triangles.size(), 0);
  return result;
}

/// Facets that no evidence reaches take part with an arbitrary class, which costs nothing there.
std::vector<ClassIndex> without_gaps(std::vector<ClassIndex> classes) {
  std::replace(classes.begin(), classes.end(), kNoClass, ClassIndex{0});
  return classes;
}

std::size_t count_changed(const TriangleMesh& mesh, const std::vector<Label>& labels) {
  std::size_t changed = 0;
  for (std::size_t f = 0; f < labels.size(); ++f) {
    const Label before = mesh.labels.empty() ? kUnlabelled : mesh.labels[f];
    changed += labels[f] != before ? 1 : 0;
  }
  return changed;
}

LabelingResult solve(const TriangleMesh& mesh, Votes votes, const LabelingConfig& config) {
  const FacetGraph graph = make_facet_graph(mesh, config);
  const FacetField field = make_field(mesh, votes, graph, config);
  PottsSolution solution =
      minimise_potts(field.problem, without_gaps(field.start), config.max_sweeps);
  LabelingResult result = unlabelled(mesh);
  for (std::size_t f = 0; f < result.labels.size(); ++f) {
    if (field.start[f] != kNoClass) {
      result.labels[f] = votes.classes[solution.labels[f]];
    }
  }
  result.confidence = label_margins(field, graph, solution.labels);
  result.views = std::move(votes.facet_views);
  result.energy_before = static_cast<double>(solution.energies.front()) / kCostUnit;
  result.energy_after = static_cast<double>(solution.energies.back()) / kCostUnit;
  return result;
}

/// Facet of the whole mesh -> facet of the observed part, kNotObserved for gaps.
std::vector<std::int32_t> observed_index(const TriangleMesh& whole, const ObservedMesh& observed) {
  std::vector<std::int32_t> index(whole.triangles.size(), kNotObserved);
  for (std::size_t k = 0; k < observed.whole_facets().size(); ++k) {
    index[observed.whole_facets()[k]] = static_cast<std::int32_t>(k);
  }
  return index;
}

/// Gaps take no part: they would carry classes across space that nobody saw.
LabelingResult label_observed(const TriangleMesh& whole,
                              const std::vector<LabeledView>& views,
                              const std::vector<FacetImage>& renderings,
                              const LabelingConfig& config) {
  const ObservedMesh observed(whole);
  Votes votes =
      count_votes(observed.mesh(), views, renderings, observed_index(whole, observed), config);
  if (votes.classes.empty()) {
    return unlabelled(whole);
  }
  const LabelingResult part = solve(observed.mesh(), std::move(votes), config);
  LabelingResult result = unlabelled(whole);
  for (std::size_t k = 0; k < part.labels.size(); ++k) {
    const std::uint32_t f = observed.whole_facets()[k];
    result.labels[f] = part.labels[k];
    result.confidence[f] = part.confidence[k];
    result.views[f] = part.views[k];
  }
  result.energy_before = part.energy_before;
  result.energy_after = part.energy_after;
  return result;
}

}  // namespace

LabelingResult label_facets(const TriangleMesh& mesh,
                            const std::vector<LabeledView>& views,
                            const std::vector<FacetImage>& renderings,
                            const LabelingConfig& config) {
  check_config(config);
  validate(mesh);
  check_views(mesh, views, renderings);
  LabelingResult result = label_observed(mesh, views, renderings, config);
  result.changed = count_changed(mesh, result.labels);
  return result;
}

void apply_labeling(const LabelingResult& labeling, TriangleMesh* mesh) {
  std::vector<std::uint16_t> views = labeling.views;
  for (std::size_t f = 0; f < views.size(); ++f) {
    views[f] = is_gap(*mesh, f) ? 0 : std::max<std::uint16_t>(views[f], 1);
  }
  mesh->labels = labeling.labels;
  mesh->confidence = labeling.confidence;
  mesh->views = std::move(views);
}

}  // namespace facet_mapping
