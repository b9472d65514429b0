// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "facet_mapping/evaluation/report.h"

namespace facet_mapping {
namespace {

// Keeps the order in which keys are written.
using nlohmann::ordered_json;

ordered_json depth_json(const DepthScores& scores) {
  return {{"truth_pixels", scores.truth_pixels},
          {"covered_pixels", scores.covered_pixels},
          {"counted_pixels", scores.counted_pixels},
          {"completeness", scores.completeness},
          {"mae_m", scores.mae_m},
          {"median_m", scores.median_m},
          {"rms_m", scores.rms_m},
          {"bias_m", scores.bias_m},
          {"trimmed_mae_m", scores.trimmed_mae_m},
          {"trimmed_rms_m", scores.trimmed_rms_m},
          {"trimmed_share", scores.trimmed_share},
          {"within_absolute", scores.within_absolute},
          {"within_relative", scores.within_relative}};
}

ordered_json class_json(const ClassScores& scores, const LabelSet& labels) {
  return {{"id", scores.id},
          {"name", labels.name_of(scores.id)},
          {"truth_pixels", scores.truth_pixels},
          {"predicted_pixels", scores.predicted_pixels},
          {"correct_pixels", scores.correct_pixels},
          {"precision", scores.precision},
          {"recall", scores.recall},
          {"f_score", scores.f_score},
          {"iou", scores.iou}};
}

ordered_json labels_json(const LabelScores& scores, const LabelSet& labels) {
  ordered_json classes = ordered_json::array();
  for (const ClassScores& one : scores.classes) {
    classes.push_back(class_json(one, labels));
  }
  return {{"pixels", scores.pixels},
          {"predicted_pixels", scores.predicted_pixels},
          {"accuracy", scores.accuracy},
          {"precision", scores.precision},
          {"recall", scores.recall},
          {"f_score", scores.f_score},
          {"mean_iou", scores.mean_iou},
          {"counted_classes", scores.counted_classes},
          {"classes", classes}};
}

ordered_json areas_json(const std::vector<ClassArea>& areas, const LabelSet& labels) {
  ordered_json list = ordered_json::array();
  for (const ClassArea& area : areas) {
    list.push_back({{"id", area.id},
                    {"name", labels.name_of(area.id)},
                    {"facets", area.facets},
                    {"area_m2", area.area_m2}});
  }
  return list;
}

ordered_json mesh_json(const NamedEvaluation& mesh, const LabelSet& labels) {
  const MeshEvaluation& evaluation = mesh.evaluation;
  ordered_json views = ordered_json::array();
  for (const ViewScores& view : evaluation.views) {
    views.push_back({{"frame", view.frame}, {"depth", depth_json(view.depth)}});
  }
  ordered_json json = {{"name", mesh.name},
                       {"facets", evaluation.facets},
                       {"vertices", evaluation.vertices},
                       {"depth_image_views", evaluation.depth_image_views},
                       {"scan_views", evaluation.scan_views},
                       {"label_views", evaluation.label_views},
                       {"depth", depth_json(evaluation.depth)}};
  if (evaluation.self_intersections) {
    json["self_intersections"] = *evaluation.self_intersections;
  }
  if (evaluation.label_views > 0) {
    json["labels"] = labels_json(evaluation.labels, labels);
  }
  json["areas"] = areas_json(evaluation.areas, labels);
  json["views"] = views;
  return json;
}

}  // namespace

std::string evaluation_json(const std::vector<NamedEvaluation>& meshes,
                            const DepthErrorOptions& depth,
                            const LabelSet& labels) {
  ordered_json list = ordered_json::array();
  for (const NamedEvaluation& mesh : meshes) {
    list.push_back(mesh_json(mesh, labels));
  }
  const ordered_json json = {{"max_depth_m", depth.max_depth_m},
                             {"max_error_m", depth.max_error_m},
                             {"absolute_bounds_m", depth.absolute_bounds_m},
                             {"relative_bounds", depth.relative_bounds},
                             {"meshes", list}};
  return json.dump(2) + "\n";
}

}  // namespace facet_mapping
