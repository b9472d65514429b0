// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The minimisation at one pyramid level: the energies of a shape and one iteration of descent.
#pragma once

#include <optional>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/geometry/self_intersections.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/labels/labeled_view.h"
#include "facet_mapping/refinement/pairwise_semantic.h"
#include "facet_mapping/refinement/photometric_energy.h"
#include "facet_mapping/refinement/refiner.h"
#include "facet_mapping/refinement/semantic_energy.h"
#include "facet_mapping/refinement/smoothing.h"
#include "facet_mapping/refinement/surface_view.h"

namespace facet_mapping {

/// A shape with everything that is known about it at this level.
struct Shape {
  TriangleMesh mesh;
  std::vector<SurfaceView> surfaces;
  PhotometricEnergy photometric;
  SemanticEnergy semantic;
  std::vector<SemanticGate> gates;
  PairwiseSemanticEnergy pairwise;  ///< in that mode only
  std::vector<FacetPair> crossing;  ///< facets that cross: kept by the iterations, which add none

  EnergyTerms terms() const { return {photometric.mean(), semantic.mean()}; }
};

class LevelProblem {
 public:
  /// `views` at this level's size; `labels` and `config` must outlive the problem.
  LevelProblem(const std::vector<LabeledView>& views,
               const LabelSet& labels,
               const RefinementConfig& config);

  const std::vector<View>& views() const { return poses_; }

  std::vector<SurfaceView> render(const TriangleMesh& mesh) const;

  /// Chooses the partners of each view by this shape.
  void choose_pairs(const TriangleMesh& mesh, const std::vector<SurfaceView>& surfaces);

  const std::vector<std::vector<int>>& pairs() const { return partners_; }
  void use_pairs(const std::vector<std::vector<int>>& partners) { partners_ = partners; }

  /// Renders the mesh and evaluates its energies, with gradients if asked for.
  Shape evaluate(TriangleMesh mesh, bool with_gradient) const;

  /// Prepares iterations on the tessellation of `shape`: they may only move vertices.
  void start(const Shape& shape);

  /// One iteration: a step that lowers the total energy, halved until it does; nothing if none was
  /// found, that is, the shape is at a minimum. No pair of facets crosses afterwards that is not in
  /// the shape's list.
  std::optional<Shape> improve(const Shape& shape) const;

  /// What the segmentations add to the energy of a shape, in the units of a photometric sum over
  /// `pixels` pixels.
  double label_energy(const Shape& shape, std::size_t pixels) const {
    return label_energy(shape, shape.semantic.sum, pixels);
  }

 private:
  double label_energy(const Shape& shape, double semantic_sum, std::size_t pixels) const;
  bool is_single_view() const;
  VectorField find_step(const Shape& shape, const SmoothingTerm& smoothing) const;
  double semantic_scale() const;
  VertexField semantic_field(const Shape& shape) const;
  void evaluate_semantic(Shape* shape, bool with_gradient) const;
  void smooth_planes(const TriangleMesh& mesh);

  const LabelSet& labels_;
  const RefinementConfig& config_;
  std::vector<View> poses_;
  std::vector<cv::Mat> sky_;  ///< CV_8UC1 per view, 255 where the segmentation says sky, or empty
  std::vector<PhotometricView> photometric_views_;
  std::vector<SemanticView> semantic_views_;
  std::vector<std::vector<int>> partners_;
  std::optional<UmbrellaOperator> umbrella_;
  std::vector<double> weights_;
};

}  // namespace facet_mapping
