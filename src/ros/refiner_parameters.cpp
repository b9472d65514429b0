// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

namespace facet_mapping {
namespace {

void add_flows(ParameterTable* table, RefinementConfig* c) {
  table->add("refinement/levels", &c->levels, "", "image pyramid levels, coarse to fine", {1, 8});
  table->add("refinement/iterations", &c->iterations, "", "iterations per level", {1, 1000});
  table->add("refinement/photometric", &c->photometric, "use the photometric flow between views");
  table->add_choice<SemanticMode>(
      "refinement/semantic_mode",
      &c->semantic,
      {{"off", SemanticMode::kOff},
       {"normal", SemanticMode::kNormal},
       {"full", SemanticMode::kFull},
       {"split", SemanticMode::kSplit},
       {"pairwise", SemanticMode::kPairwise}},
      "semantic flow: off; normal: along the surface normal; full: class borders may slide, too; "
      "split: contours move the shape, borders on a continuous surface slide; "
      "pairwise: between views, for comparison");
  table->add("refinement/semantic_weight",
             &c->semantic_weight,
             "",
             "weight of the semantic energy beside the photometric one",
             {0.0, 1e6});
  table->add("refinement/smoothing", &c->smoothing, "", "weight of the umbrella operator", kUnit);
  table->add(
      "refinement/thin_plate", &c->thin_plate, "", "weight of the second-order smoothing", kUnit);
  table->add("refinement/planar_smoothing",
             &c->planar_smoothing,
             "",
             "factor of both weights on classes marked planar",
             {1.0, 1000.0});
  table->add("refinement/keep_quality",
             &c->keep_quality,
             "collapse and flip edges of badly shaped facets before each level");
  table->add("refinement/relabel", &c->relabel, "label the mesh anew after each level");
}

void add_details(ParameterTable* table, RefinementConfig* c) {
  table->add("refinement/ncc_window_px",
             &c->ncc_window_px,
             "px",
             "side of the correlation window, odd",
             {3, 31});
  table->add("refinement/semantic_window_px",
             &c->semantic_window_px,
             "px",
             "side of the semantic window, odd",
             {3, 63});
  table->add("refinement/min_incidence_cos",
             &c->min_incidence_cos,
             "",
             "pixels that see the surface at a flatter angle do not count",
             {0.01, 1.0});
  table->add("refinement/pairs_per_view",
             &c->pairs_per_view,
             "",
             "best partners kept for each view",
             {1, 100});
  table->add("refinement/max_step_edge_fraction",
             &c->max_step_edge_fraction,
             "",
             "longest step of a vertex, in mean edge lengths around it",
             {1e-6, 1.0});
  table->add("refinement/subdivide_px",
             &c->subdivide_px,
             "px",
             "facets covering more pixels than this in their best view are split",
             {1.0, kInfinity});
  table->add_check([c]() -> std::string {
    return c->ncc_window_px % 2 == 1 && c->semantic_window_px % 2 == 1
               ? ""
               : "'refinement/ncc_window_px' and 'refinement/semantic_window_px' must be odd";
  });
}

void add_labeling(ParameterTable* table, LabelingConfig* c) {
  table->add("labeling/beta", &c->beta, "", "floor of the data probability", {1e-6, 1.0});
  table->add("labeling/pixel_votes",
             &c->pixel_votes,
             "evidence from all pixels that show a facet; false: from its vertices alone");
  table->add_choice<OrientationPrior>("labeling/orientation_prior",
                                      &c->orientation_prior,
                                      {{"global", OrientationPrior::kGlobal},
                                       {"mixture", OrientationPrior::kMixture},
                                       {"local", OrientationPrior::kLocal}},
                                      "prior on facet orientation: global: one direction per "
                                      "class; mixture: several; local: one per neighbourhood");
  table->add("labeling/normal_weight",
             &c->normal_weight,
             "",
             "weight of the prior on facet orientation",
             {0.0, 1000.0});
  table->add("labeling/normal_floor",
             &c->normal_floor,
             "",
             "floor of the orientation probability, so that images outvote it",
             {1e-6, 1.0});
  table->add("labeling/min_normal_sigma_deg",
             &c->min_normal_sigma_deg,
             "deg",
             "least angular deviation that a class is credited with",
             {0.1, 180.0});
  table->add("labeling/min_normal_facets",
             &c->min_normal_facets,
             "",
             "classes with fewer facets have no orientation prior",
             {0, 1e9});
  table->add("labeling/local_facets",
             &c->local_facets,
             "",
             "facets in a neighbourhood of the local orientation prior",
             {1, 1e6});
  table->add("labeling/smooth_equal",
             &c->smooth_equal,
             "",
             "probability that neighbours have equal classes",
             {1e-6, 1.0});
  table->add("labeling/smooth_different",
             &c->smooth_different,
             "",
             "probability that neighbours have different classes",
             {1e-6, 1.0});
  table->add("labeling/own_label_weight",
             &c->own_label_weight,
             "nats",
             "cost of dropping the mesh's own label where no image sees",
             {0.0, 1000.0});
  table->add("labeling/depth_tolerance",
             &c->depth_tolerance,
             "",
             "relative depth slack of the visibility test",
             kPositive);
  table->add("labeling/max_sweeps",
             &c->max_sweeps,
             "",
             "alpha-expansion sweeps over all classes",
             {1, 1000});
  table->add_check([c]() -> std::string {
    return c->smooth_different <= c->smooth_equal
               ? ""
               : "'labeling/smooth_different' must not be above 'labeling/smooth_equal'";
  });
}

}  // namespace

ParameterTable parameter_table(RefinerNodeConfig* config) {
  ParameterTable table;
  add_segmentation(&table, &config->segmentation);
  add_pose(&table, &config->pose);
  table.add("keyframe_translation_m",
            &config->keyframe_translation_m,
            "m",
            "an image becomes a keyframe after this much motion ...",
            kNotNegative);
  table.add("keyframe_rotation_deg",
            &config->keyframe_rotation_deg,
            "deg",
            "... or this much rotation",
            {0.0, 180.0});
  table.add("max_keyframes",
            &config->max_keyframes,
            "",
            "keyframes kept; the oldest are dropped and counted",
            {2, 100000});
  table.add("max_keyframe_mib",
            &config->max_keyframe_mib,
            "MiB",
            "memory of the images kept; the oldest are dropped and counted",
            {1, 1e6});
  add_flows(&table, &config->refinement);
  add_details(&table, &config->refinement);
  add_labeling(&table, &config->refinement.labeling);
  add_output(&table, &config->output);
  return table;
}

}  // namespace facet_mapping
