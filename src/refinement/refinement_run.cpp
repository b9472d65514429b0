// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_run.h"

#include <algorithm>
#include <functional>

#include "facet_mapping/refinement/crossings.h"
#include "facet_mapping/refinement/image_pyramid.h"
#include "facet_mapping/refinement/mesh_quality.h"
#include "facet_mapping/refinement/subdivision.h"

namespace facet_mapping {
namespace {

std::vector<LabeledView> shrink_views(const std::vector<LabeledView>& views, int level) {
  std::vector<LabeledView> small;
  small.reserve(views.size());
  for (const LabeledView& view : views) {
    small.push_back(shrink_view(view, level));
  }
  return small;
}

}  // namespace

RefinementRun::RefinementRun(const TriangleMesh& mesh,
                             const std::vector<LabeledView>& views,
                             const LabelSet& labels,
                             const RefinementConfig& config,
                             const ProgressCallback& progress)
    : start_(mesh),
      views_(views),
      labels_(labels),
      config_(config),
      progress_(progress),
      finest_(views, labels, config),
      current_(mesh) {
  if (current_.start_points.empty()) {
    current_.start_points = current_.vertices;
  }
}

void RefinementRun::begin() {
  if (current_.labels.empty() && has_segmentation()) {
    relabel(&current_);
  }
  finest_.choose_pairs(current_, finest_.render(current_));
}

RefinementResult RefinementRun::run() {
  result_.facets_before = start_.triangles.size();
  begin();
  const Measured before = measure(current_, 0);
  result_.before = before.terms;
  TriangleMesh best = current_;
  for (int level = config_.levels - 1; level >= 0 && config_.iterations > 0; --level) {
    if (!refine_level(level)) {
      result_.cancelled = true;
      break;
    }
  }
  if (config_.relabel && has_segmentation()) {
    relabel(&current_);
  }
  result_.after = before.terms;
  if (!take_if_better(before, std::move(current_), &best)) {
    result_.relabelled = 0;
    if (config_.relabel && has_segmentation()) {
      TriangleMesh relabelled = best;
      relabel(&relabelled);
      result_.relabelled *= take_if_better(before, std::move(relabelled), &best) ? 1 : 0;
    }
  }
  result_.facets_after = best.triangles.size();
  result_.mesh = std::move(best);
  return std::move(result_);
}

bool RefinementRun::take_if_better(const Measured& before, TriangleMesh mesh, TriangleMesh* best) {
  const Measured after = measure(mesh, before.photometric.pixels);
  if (change(before, after) > 0.0) {
    return false;
  }
  result_.after = after.terms;
  *best = std::move(mesh);
  return true;
}

RefinementRun::Measured RefinementRun::measure(const TriangleMesh& mesh, std::size_t pixels) const {
  Shape shape = finest_.evaluate(mesh, false);
  const std::size_t count =
      std::max<std::size_t>(1, pixels > 0 ? pixels : shape.photometric.pixels);
  const double labels = finest_.label_energy(shape, count) / static_cast<double>(count);
  return {shape.terms(), std::move(shape.photometric), labels};
}

double RefinementRun::change(const Measured& from, const Measured& to) const {
  const double photometric =
      config_.photometric ? mean_change(from.photometric, to.photometric) : 0.0;
  return photometric + to.labels - from.labels;
}

bool RefinementRun::has_segmentation() const {
  for (const LabeledView& view : views_) {
    if (!view.labels.empty()) {
      return true;
    }
  }
  return false;
}

bool RefinementRun::refine_level(int level) {
  if (level == 0) {
    return iterate(0, &finest_);
  }
  LevelProblem problem(shrink_views(views_, level), labels_, config_);
  problem.use_pairs(finest_.pairs());
  return iterate(level, &problem);
}

void RefinementRun::split_facets(const LevelProblem& problem) {
  const std::size_t facets = current_.triangles.size();
  std::vector<double> pixels = best_view_pixels(current_, problem.render(current_));
  const std::vector<std::uint8_t> inside = facets_of_part(current_, config_.part);
  std::transform(pixels.begin(), pixels.end(), inside.begin(), pixels.begin(), std::multiplies<>());
  current_ = subdivide_beside_crossings(current_, std::move(pixels), config_.subdivide_px);
  if (config_.relabel && has_segmentation() && current_.triangles.size() != facets) {
    relabel(&current_);
  }
}

bool RefinementRun::iterate(int level, LevelProblem* problem) {
  split_facets(*problem);
  if (config_.keep_quality) {
    current_ = improve_quality(current_, {}, nullptr, facets_of_part(current_, config_.part));
  }
  Shape shape = problem->evaluate(std::move(current_), true);
  problem->start(shape);
  shape.crossing = find_self_intersections(shape.mesh);
  bool go_on = true;
  for (int k = 0; k < config_.iterations && go_on; ++k) {
    std::optional<Shape> improved = problem->improve(shape);
    if (!improved) {
      break;
    }
    shape = std::move(*improved);
    go_on = report(level, k, shape.terms());
  }
  current_ = std::move(shape.mesh);
  return go_on;
}

bool RefinementRun::report(int level, int iteration, const EnergyTerms& energy) {
  if (!progress_) {
    return true;
  }
  RefinementProgress progress;
  progress.level = level;
  progress.iteration = iteration;
  progress.energy = energy;
  const int done = (config_.levels - 1 - level) * config_.iterations + iteration + 1;
  progress.fraction = static_cast<double>(done) / (config_.levels * config_.iterations);
  return progress_(progress);
}

}  // namespace facet_mapping
