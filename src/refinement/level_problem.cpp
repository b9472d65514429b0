// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/level_problem.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "facet_mapping/refinement/crossings.h"
#include "facet_mapping/refinement/smoothing_weights.h"
#include "facet_mapping/refinement/step.h"
#include "facet_mapping/refinement/view_pairs.h"

namespace facet_mapping {

namespace {

/// Lumped curvatures bound the true ones from above: with these steps come out short. Too long a
/// step is halved.
constexpr double kCurvatureShare = 0.6;

cv::Mat find_sky(const cv::Mat& segmentation, const LabelSet& labels) {
  cv::Mat sky;
  for (const ClassInfo& c : labels.classes()) {
    if (c.sky && !segmentation.empty()) {
      const cv::Mat here = segmentation == static_cast<double>(c.id);
      sky = sky.empty() ? here : cv::Mat(sky | here);
    }
  }
  return sky;
}

/// Only pixels that show one of the facets are of use; partners are sampled everywhere.
void keep_part(const std::vector<std::uint8_t>& facets, std::vector<SurfaceView>* surfaces) {
  tbb::parallel_for(std::size_t{0}, surfaces->size(), [&](std::size_t i) {
    SurfaceView& surface = (*surfaces)[i];
    for (int y = 0; y < surface.usable.rows; ++y) {
      for (int x = 0; x < surface.usable.cols; ++x) {
        const int facet = surface.image.facets.at<int>(y, x);
        if (facet < 0 || facets[facet] == 0) {
          surface.usable.at<std::uint8_t>(y, x) = 0;
        }
      }
    }
  });
}

}  // namespace

LevelProblem::LevelProblem(const std::vector<LabeledView>& views,
                           const LabelSet& labels,
                           const RefinementConfig& config)
    : labels_(labels), config_(config), partners_(views.size()) {
  for (const LabeledView& view : views) {
    poses_.push_back(view.view);
    photometric_views_.push_back(make_photometric_view(view.view, view.gray, config.ncc_window_px));
    semantic_views_.push_back({view.view, view.labels});
    sky_.push_back(find_sky(view.labels, labels));
  }
}

std::vector<SurfaceView> LevelProblem::render(const TriangleMesh& mesh) const {
  std::vector<SurfaceView> surfaces = render_surfaces(mesh, poses_, config_.min_incidence_cos);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!sky_[i].empty()) {
      surfaces[i].usable.setTo(cv::Scalar(0), sky_[i]);
      surfaces[i].sampled.setTo(cv::Scalar(0), sky_[i]);
    }
  }
  if (!config_.part.is_everything()) {
    keep_part(facets_of_part(mesh, config_.part), &surfaces);
  }
  return surfaces;
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
  evaluate_semantic(&shape, with_gradient);
  return shape;
}

VertexField LevelProblem::semantic_field(const Shape& shape) const {
  SemanticGradient parts =
      semantic_gradient(shape.mesh, semantic_views_, shape.surfaces, shape.gates);
  if (config_.semantic == SemanticMode::kSplit) {
    keep_normal_part(shape.mesh, &parts.contours);
    keep_tangential_part(shape.mesh, &parts.seams);
  }
  parts.contours.add(parts.seams);
  if (config_.semantic == SemanticMode::kNormal) {
    keep_normal_part(shape.mesh, &parts.contours);
  }
  return std::move(parts.contours);
}

bool LevelProblem::is_single_view() const {
  return config_.semantic != SemanticMode::kOff && config_.semantic != SemanticMode::kPairwise;
}

void LevelProblem::evaluate_semantic(Shape* shape, bool with_gradient) const {
  const bool single = is_single_view();
  if (single || !with_gradient) {  // otherwise it is only reported, before and after
    shape->gates =
        semantic_gates(shape->mesh, semantic_views_, shape->surfaces, config_.semantic_window_px);
    shape->semantic = semantic_energy(shape->mesh, semantic_views_, shape->surfaces, shape->gates);
  }
  if (single && with_gradient) {
    shape->semantic.field = semantic_field(*shape);
  }
  if (config_.semantic == SemanticMode::kPairwise) {
    shape->pairwise = pairwise_semantic_energy(
        shape->mesh, semantic_views_, shape->surfaces, partners_, with_gradient);
  }
}

void LevelProblem::start(const Shape& shape) {
  umbrella_.emplace(shape.mesh);
  weights_ = smoothing_weights(shape.mesh, poses_, shape.surfaces, config_.pairs_per_view);
  smooth_planes(shape.mesh);
  const std::vector<std::uint8_t> inside =
      vertices_inside(shape.mesh, facets_of_part(shape.mesh, config_.part));
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    weights_[k] *= inside[k];
  }
}

void LevelProblem::smooth_planes(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> planar(mesh.vertices.size(), 1);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const ClassInfo* c = mesh.labels.empty() ? nullptr : labels_.find(mesh.labels[f]);
    for (const std::uint32_t v : mesh.triangles[f]) {
      planar[v] &= c != nullptr && c->planar ? 1 : 0;
    }
  }
  for (std::size_t k = 0; k < planar.size(); ++k) {
    weights_[k] *= planar[k] != 0 ? config_.planar_smoothing : 1.0;
  }
}

double LevelProblem::semantic_scale() const {
  // A border that is a pixel off shall weigh as much as a well-textured pixel whose surface is: in
  // all its pairs, since it takes part in one segmentation only.
  return config_.semantic_weight * config_.pairs_per_view * kPixelInformation;
}

double LevelProblem::label_energy(const Shape& shape,
                                  double semantic_sum,
                                  std::size_t pixels) const {
  if (config_.semantic == SemanticMode::kPairwise) {
    // The mean, not the sum: hiding pixels must not count as an improvement.
    const auto count = static_cast<double>(std::max<std::size_t>(1, shape.pairwise.pixels));
    return config_.semantic_weight * shape.pairwise.sum / count * static_cast<double>(pixels);
  }
  return is_single_view() ? semantic_scale() * semantic_sum : 0.0;
}

VectorField LevelProblem::find_step(const Shape& shape, const SmoothingTerm& smoothing) const {
  VertexField data(shape.mesh.vertices.size());
  if (config_.photometric) {
    data.add(shape.photometric.field);
  }
  if (config_.semantic == SemanticMode::kPairwise) {
    data.add(shape.pairwise.field, config_.semantic_weight);
  } else if (is_single_view()) {
    data.add(shape.semantic.field, semantic_scale());
  }
  for (double& curvature : data.curvature) {
    curvature *= kCurvatureShare;
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
  const double others = label_energy(shape, pixels) + smoothing.energy(shape.mesh.vertices);
  VectorField step = find_step(shape, smoothing);
  for (int k = 0; k <= kHalvings; ++k) {
    prevent_crossings(shape.mesh, shape.crossing, &step);
    TriangleMesh moved = shape.mesh;
    for (std::size_t v = 0; v < step.size(); ++v) {
      moved.vertices[v] += step[v];
    }
    Shape trial = evaluate(std::move(moved), true);
    const double semantic_sum =
        is_single_view()
            ? semantic_energy(trial.mesh, semantic_views_, trial.surfaces, shape.gates).sum
            : 0.0;
    double change =
        label_energy(trial, semantic_sum, pixels) + smoothing.energy(trial.mesh.vertices) - others;
    if (config_.photometric) {
      change += mean_change(shape.photometric, trial.photometric) * static_cast<double>(pixels);
    }
    if (change < 0.0) {
      trial.crossing = keep_crossing(trial.mesh, shape.crossing);
      return trial;
    }
    for (Eigen::Vector3d& s : step) {
      s *= 0.5;
    }
  }
  return std::nullopt;
}

}  // namespace facet_mapping
