// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/level_problem.h"

#include <algorithm>

#include "facet_mapping/refinement/smoothing_weights.h"
#include "facet_mapping/refinement/step.h"
#include "facet_mapping/refinement/view_pairs.h"

namespace facet_mapping {

LevelProblem::LevelProblem(const std::vector<LabeledView>& views, const RefinementConfig& config)
    : config_(config), partners_(views.size()) {
  for (const LabeledView& view : views) {
    poses_.push_back(view.view);
    photometric_views_.push_back(make_photometric_view(view.view, view.gray, config.ncc_window_px));
    semantic_views_.push_back({view.view, view.labels});
  }
}

std::vector<SurfaceView> LevelProblem::render(const TriangleMesh& mesh) const {
  return render_surfaces(mesh, poses_, config_.min_incidence_cos);
}

void LevelProblem::choose_pairs(const TriangleMesh& mesh,
                                const std::vector<SurfaceView>& surfaces) {
  ViewPairConfig pairs;
  pairs.pairs_per_view = config_.pairs_per_view;
  partners_ = select_view_pairs(mesh, poses_, surfaces, pairs);
}

Shape LevelProblem::evaluate(TriangleMesh mesh, bool with_gradient) const {
  Shape shape;
  shape.mesh = std::move(mesh);
  shape.surfaces = render(shape.mesh);
  ZnccConfig zncc;
  zncc.window_px = config_.ncc_window_px;
  shape.photometric = photometric_energy(
      shape.mesh, photometric_views_, shape.surfaces, partners_, zncc, with_gradient);
  const bool semantic = config_.semantic != SemanticMode::kOff;
  if (semantic || !with_gradient) {  // without the term it is only reported
    shape.gates =
        semantic_gates(shape.mesh, semantic_views_, shape.surfaces, config_.semantic_window_px);
    shape.semantic = semantic_energy(shape.mesh, semantic_views_, shape.surfaces, shape.gates);
  }
  if (with_gradient && semantic) {
    shape.semantic.field =
        semantic_gradient(shape.mesh, semantic_views_, shape.surfaces, shape.gates);
    if (config_.semantic == SemanticMode::kNormal) {
      keep_normal_part(shape.mesh, &shape.semantic.field);
    }
  }
  return shape;
}

void LevelProblem::start(const Shape& shape) {
  umbrella_.emplace(shape.mesh);
  weights_ = smoothing_weights(shape.mesh, poses_, shape.surfaces, config_.pairs_per_view);
}

double LevelProblem::semantic_scale() const {
  return config_.semantic == SemanticMode::kOff ? 0.0
                                                : config_.semantic_weight * config_.pairs_per_view;
}

double LevelProblem::data_energy(const Shape& shape,
                                 const std::vector<SemanticGate>& gates,
                                 std::size_t pixels) const {
  // The mean, not the sum: hiding pixels must not count as an improvement.
  double energy =
      config_.photometric ? shape.photometric.mean() * static_cast<double>(pixels) : 0.0;
  if (semantic_scale() > 0.0) {
    energy +=
        semantic_scale() * semantic_energy(shape.mesh, semantic_views_, shape.surfaces, gates).sum;
  }
  return energy;
}

double LevelProblem::mean_energy(const Shape& shape) const {
  const std::size_t pixels = std::max<std::size_t>(1, shape.photometric.pixels);
  return data_energy(shape, shape.gates, pixels) / static_cast<double>(pixels);
}

VectorField LevelProblem::find_step(const Shape& shape, const SmoothingTerm& smoothing) const {
  VertexField data(shape.mesh.vertices.size());
  if (config_.photometric) {
    data.add(shape.photometric.field);
  }
  if (semantic_scale() > 0.0) {
    data.add(shape.semantic.field, semantic_scale());
  }
  std::vector<std::uint8_t> movable(weights_.size());
  for (std::size_t k = 0; k < movable.size(); ++k) {
    movable[k] = weights_[k] > 0.0 ? 1 : 0;
  }
  VectorField step = solve_step(shape.mesh, data, smoothing, movable);
  limit_step(shape.mesh, umbrella_->neighbours(), config_.max_step_edge_fraction, &step);
  return step;
}

std::optional<Shape> LevelProblem::improve(const Shape& shape) const {
  constexpr int kHalvings = 3;
  SmoothingConfig smooth;
  smooth.umbrella = config_.smoothing;
  smooth.thin_plate = config_.thin_plate;
  const SmoothingTerm smoothing(shape.mesh, *umbrella_, weights_, smooth);
  const std::size_t pixels = shape.photometric.pixels;
  const double before =
      data_energy(shape, shape.gates, pixels) + smoothing.energy(shape.mesh.vertices);
  VectorField step = find_step(shape, smoothing);
  for (int k = 0; k <= kHalvings; ++k) {
    prevent_flips(shape.mesh, &step);
    TriangleMesh moved = shape.mesh;
    for (std::size_t v = 0; v < step.size(); ++v) {
      moved.vertices[v] += step[v];
    }
    Shape trial = evaluate(std::move(moved), true);
    const double after =
        data_energy(trial, shape.gates, pixels) + smoothing.energy(trial.mesh.vertices);
    if (after < before) {
      return trial;
    }
    for (Eigen::Vector3d& s : step) {
      s *= 0.5;
    }
  }
  return std::nullopt;
}

}  // namespace facet_mapping
