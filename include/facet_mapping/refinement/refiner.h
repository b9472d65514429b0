// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The refinement loop: photometric flow, semantic flow, smoothing, subdivision, relabelling
// (Romanoni et al. 2017, Sec. 3.2; Vu et al. 2012).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/geometry/mesh_part.h"
#include "facet_mapping/labeling/facet_labeling.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/labels/labeled_view.h"

namespace facet_mapping {

enum class SemanticMode {
  kOff,       ///< photometric only (Vu et al. 2012)
  kNormal,    ///< only the part of the semantic gradient along the vertex normal (the paper)
  kFull,      ///< the whole gradient: class borders may also slide over the surface
  kSplit,     ///< along the normal at occluding contours, across it where classes share an edge:
              ///< contours move the shape, borders on a continuous surface slide over it
  kPairwise,  ///< masks of one view against those of another (Blaha et al. 2017), for comparison
};

struct RefinementConfig {
  int levels = 2;                                 ///< image pyramid levels, coarse to fine
  int iterations = 5;                             ///< iterations per level (the paper's K)
  bool photometric = true;                        ///< use the photometric flow
  SemanticMode semantic = SemanticMode::kNormal;  ///< how the semantic flow acts
  double semantic_weight = 1.0;     ///< weight of the semantic energy beside the photometric one
  double smoothing = 0.05;          ///< weight of the umbrella operator, 0..1
  double thin_plate = 0.05;         ///< weight of the second-order smoothing, 0..1
  double planar_smoothing = 3.0;    ///< factor of both on classes marked planar, at least 1
  int ncc_window_px = 5;            ///< side of the correlation window, odd
  int semantic_window_px = 7;       ///< side of the semantic window W, odd
  double min_incidence_cos = 0.15;  ///< pixels that see the surface at a flatter angle do not count
  int pairs_per_view = 2;           ///< best partners kept for each view
  double max_step_edge_fraction = 0.25;  ///< longest step of a vertex, in mean edge lengths
  double subdivide_px = 24.0;  ///< facets covering more pixels in their best view are split
  bool relabel = true;         ///< run the labelling after each level
  bool keep_quality = true;    ///< collapse and flip badly shaped facets before each level
  LabelingConfig labeling;
  MeshPart part;  ///< what may change; facets outside keep their shape and class
};

/// One term's energy, for the report and the progress topic.
struct EnergyTerms {
  double photometric = 0.0;  ///< mean of r * (1 - zncc) over the pixels of all pairs
  double semantic = 0.0;     ///< mean semantic error over the gated pixels of all views
};

struct RefinementProgress {
  int level = 0;
  int iteration = 0;
  double fraction = 0.0;  ///< of the whole job, 0..1
  EnergyTerms energy;
};

/// Returns false to stop: the best mesh so far is returned.
using ProgressCallback = std::function<bool(const RefinementProgress&)>;

struct RefinementResult {
  TriangleMesh mesh;   ///< with start_points: on the start mesh, or on that mesh's own start
  EnergyTerms before;  ///< of the start mesh on the finest level's images
  EnergyTerms after;   ///< of the result on the same images
  std::size_t facets_before = 0;
  std::size_t facets_after = 0;
  std::size_t relabelled = 0;
  bool cancelled = false;
};

/// Moves the vertices of `mesh` so that images and segmentations agree with it. A mesh without
/// labels is labelled first if there are segmentations (all of it, `config.part` or not). Pixels
/// that a segmentation calls sky (by the flag in `labels`) tell photometry nothing; facets of
/// planar classes are smoothed more. What no view sees stays where it is. Over the pixels that both
/// show, the result's energy is not above the start's; if no better shape is found, the start is
/// returned, with classes from the images if these agree with it better. (The means in the result
/// are over each shape's own pixels: they may rise where more has become visible.) With zero
/// iterations nothing but labels changes. Facets that cross no other in the start do not come to
/// cross; those that do stay whole where they can, and mostly part. Of a part, the photometric
/// energy is that of the pixels that show it, and views that do not see it are left out.
///
/// Throws std::invalid_argument if fewer than two views are given or see the part, a view has no
/// image of the camera's size, the mesh is invalid or the configuration is out of range.
RefinementResult refine(const TriangleMesh& mesh,
                        const std::vector<LabeledView>& views,
                        const LabelSet& labels,
                        const RefinementConfig& config,
                        const ProgressCallback& progress = {});

/// What a refinement with these arguments would cost on this machine as busy as it is now.
struct RefinementEstimate {
  EnergyTerms energy;       ///< of the start mesh on the finest level's images
  std::size_t facets = 0;   ///< of the result, about
  std::size_t views = 0;    ///< that see the part
  double measured_s = 0.0;  ///< wall time that the estimate took
  double seconds = 0.0;     ///< wall time of the refinement, about
};

/// Does what a level begins with, measures how long that takes, and changes nothing. Throws as
/// refine() does.
RefinementEstimate estimate_refinement(const TriangleMesh& mesh,
                                       const std::vector<LabeledView>& views,
                                       const LabelSet& labels,
                                       const RefinementConfig& config);

}  // namespace facet_mapping
