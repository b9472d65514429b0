// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_run.h"

#include "facet_mapping/refinement/image_pyramid.h"
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
      finest_(views, config),
      current_(mesh) {}

RefinementResult RefinementRun::run() {
  result_.facets_before = start_.triangles.size();
  if (current_.labels.empty() && has_segmentation()) {
    relabel(&current_);
  }
  finest_.choose_pairs(current_, finest_.render(current_));
  const Shape before = finest_.evaluate(current_, false);
  result_.before = before.terms();
  for (int level = config_.levels - 1; level >= 0 && !result_.cancelled; --level) {
    result_.cancelled = !refine_level(level);
  }
  if (config_.relabel && has_segmentation()) {
    relabel(&current_);
  }
  const Shape after = finest_.evaluate(std::move(current_), false);
  const bool better = finest_.mean_energy(after) <= finest_.mean_energy(before);
  const Shape& best = better ? after : before;
  result_.after = best.terms();
  result_.facets_after = best.mesh.triangles.size();
  result_.mesh = best.mesh;
  return std::move(result_);
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
  LevelProblem problem(shrink_views(views_, level), config_);
  problem.use_pairs(finest_.pairs());
  const std::size_t facets = current_.triangles.size();
  current_ = subdivide(
      current_, best_view_pixels(current_, problem.render(current_)), config_.subdivide_px);
  if (config_.relabel && has_segmentation() && current_.triangles.size() != facets) {
    relabel(&current_);
  }
  Shape shape = problem.evaluate(std::move(current_), true);
  problem.start(shape);
  bool go_on = true;
  for (int k = 0; k < config_.iterations && go_on; ++k) {
    std::optional<Shape> improved = problem.improve(shape);
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
