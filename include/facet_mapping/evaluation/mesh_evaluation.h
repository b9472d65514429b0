// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh against the ground truth of a dataset, view by view.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "facet_mapping/evaluation/depth_error.h"
#include "facet_mapping/evaluation/label_scores.h"
#include "facet_mapping/evaluation/scan_depth.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/io/dataset.h"
#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {

/// Which facets are taken away before rendering, so that what is behind them is seen.
struct Hidden {
  bool gaps = true;         ///< facets that only close the surface (see is_gap)
  bool unlabelled = false;  ///< facets without a class, in a mesh that has classes
  bool sky = false;         ///< facets of classes marked `sky`
};

struct EvaluationOptions {
  /// Frame indices to look at; empty = every frame.
  std::vector<std::size_t> views;
  DepthErrorOptions depth;
  ScanDepthOptions scan;
  /// Classes with more ground-truth pixels than this enter the label means.
  std::size_t min_class_pixels = 100;
  Hidden hidden;
  bool self_intersections = false;  ///< count them, too; takes seconds per million facets
};

struct ViewScores {
  std::size_t frame = 0;
  DepthScores depth;
};

/// How much of the mesh one class takes.
struct ClassArea {
  Label id = kUnlabelled;
  std::size_t facets = 0;
  double area_m2 = 0.0;
};

struct MeshEvaluation {
  std::size_t vertices = 0;
  std::size_t facets = 0;
  std::size_t depth_image_views = 0;  ///< views compared with a depth image
  std::size_t scan_views = 0;         ///< views compared with a LiDAR scan, having no depth image
  std::size_t label_views = 0;        ///< views compared with ground-truth labels
  DepthScores depth;                  ///< over all views
  LabelScores labels;  ///< over all views; no pixels if mesh or dataset has no labels
  std::vector<ViewScores> views;
  std::vector<ClassArea> areas;  ///< ascending ids, unlabelled last; empty without labels
  /// Pairs of facets that run through each other, hidden ones too; nothing unless asked for.
  std::optional<std::size_t> self_intersections;
};

/// Called after each view.
using EvaluationProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Compares the mesh rendered in each view with the frame's depth image, or its scan where there is
/// no depth image, and with its ground-truth labels. Ground truth of another resolution than the
/// camera's is compared at its own. Where the mesh is not seen it shows the class marked `sky`, if
/// `labels` has one, else no class. Throws std::invalid_argument on views that are not there,
/// std::runtime_error on broken files or if no view has any ground truth.
MeshEvaluation evaluate_mesh(const TriangleMesh& mesh,
                             const LabelSet& labels,
                             const Dataset& dataset,
                             const EvaluationOptions& options = {},
                             const EvaluationProgress& progress = {});

/// Compares the dataset's segmentations themselves with the ground-truth labels of the chosen
/// views, at the size of the ground truth: label_views and labels are filled, depth is empty.
/// Throws std::invalid_argument on views that are not there, std::runtime_error on broken files or
/// if no view has both.
MeshEvaluation evaluate_segmentation(const Dataset& dataset, const EvaluationOptions& options = {});

/// The mesh without the hidden facets.
TriangleMesh shown_facets(const TriangleMesh& mesh, const LabelSet& labels, const Hidden& hidden);

/// Facets and area per class, ascending ids; empty for a mesh without labels.
std::vector<ClassArea> class_areas(const TriangleMesh& mesh);

/// The frame's depth image, else its scan's depth, else an empty image.
cv::Mat true_depth(const Dataset& dataset,
                   const DatasetFrame& frame,
                   const ScanDepthOptions& options = {});

/// The view resampled to an image's size. Throws std::invalid_argument if the two differ in shape
/// (by more than 1 %); `what` names the image.
View view_of_size(const View& view, const cv::Size& size, const std::string& what);

}  // namespace facet_mapping
