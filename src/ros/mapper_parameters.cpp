// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

namespace facet_mapping {
namespace {

void add_carving(ParameterTable* table, CarvingConfig* c) {
  table->add_choice<Extraction>(
      "carving/extraction",
      &c->extraction,
      {{"graph_cut", Extraction::kGraphCut}, {"count", Extraction::kCount}},
      "how cells are called free: minimum cut with a surface quality term, or the paper's count");
  table->add("carving/surface_quality_weight",
             &c->surface_quality_weight,
             "rays",
             "graph_cut: cost of a badly shaped facet",
             kNotNegative);
  table->add("carving/evidence_cap",
             &c->evidence_cap,
             "rays",
             "graph_cut: where a cell has more evidence of free space or matter, both are scaled "
             "down to it",
             kPositive);
  table->add(
      "carving/neighbour_share",
      &c->neighbour_share,
      "",
      "share of its neighbours' mean free-space evidence that a cell gets too: fewer curtains at "
      "depth edges, more holes",
      {0, 1});
  table->add("carving/free_space_threshold",
             &c->free_space_threshold,
             "rays",
             "least free-space evidence of a free cell",
             kNotNegative);
  table->add("carving/behind_distance_m",
             &c->behind_distance_m,
             "m",
             "how far behind a point it is evidence of matter and of its class",
             kNotNegative);
  table->add("carving/steiner_spacing_m",
             &c->steiner_spacing_m,
             "m",
             "spacing of the extra vertices that bound cells; 0: none",
             kNotNegative);
  table->add("carving/steiner_reach_m",
             &c->steiner_reach_m,
             "m",
             "how far around a sensor extra vertices are laid",
             kNotNegative);
  table->add("carving/steiner_clearance_m",
             &c->steiner_clearance_m,
             "m",
             "extra vertices keep this far from points",
             kNotNegative);
  table->add("carving/max_facet_edge_m",
             &c->max_facet_edge_m,
             "m",
             "facets with a longer edge carry no class",
             kPositive);
  table->add("carving/min_component_facets",
             &c->min_component_facets,
             "facets",
             "closed parts of the surface with fewer are dropped; 0: none",
             {0, 1000000});
  table->add("carving/min_point_spacing_m",
             &c->min_point_spacing_m,
             "m",
             "a point nearer to a vertex than this joins it",
             kNotNegative);
  table->add_check([c]() -> std::string {
    try {
      validate(*c);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  });
}

void add_cloud(ParameterTable* table, CloudConfig* c) {
  table->add("cloud/voxel_m",
             &c->voxel_m,
             "m",
             "clouds without `label` (LiDAR): at most one point per cube of this size; 0: all",
             kNotNegative);
  table->add("cloud/min_range_m",
             &c->min_range_m,
             "m",
             "clouds without `label`: nearer points (the vehicle) are dropped",
             kNotNegative);
  table->add(
      "cloud/outlier_radius_m",
      &c->outlier_radius_m,
      "m",
      "clouds without `label`: points with too few others in this radius are dropped; 0: off",
      kNotNegative);
  table->add("cloud/outlier_neighbors",
             &c->outlier_neighbors,
             "",
             "clouds without `label`: fewest others in that radius",
             {0, 1000});
  table->add("cloud/sigma_m",
             &c->sigma_m,
             "m",
             "clouds without `label`: standard deviation of the range",
             kNotNegative);
}

void add_map(ParameterTable* table, MapConfig* c) {
  table->add_choice<DynamicPolicy>(
      "dynamic_classes",
      &c->dynamic,
      {{"keep", DynamicPolicy::kKeep},
       {"carve", DynamicPolicy::kCarve},
       {"drop", DynamicPolicy::kDrop}},
      "points of `dynamic` classes (cars, persons): part of the map; rays that only carve; or "
      "ignored");
  table->add("min_range_m", &c->min_range_m, "m", "nearer points are dropped", kNotNegative);
  table->add("max_range_m", &c->max_range_m, "m", "farther points are dropped", kPositive);
  table->add("keyframe_translation_m",
             &c->keyframe_translation_m,
             "m",
             "a frame is integrated after this much motion of its sensor ...",
             kNotNegative);
  table->add("keyframe_rotation_deg",
             &c->keyframe_rotation_deg,
             "deg",
             "... or this much rotation",
             {0.0, 180.0});
  table->add(
      "frozen_beyond_m",
      &c->frozen_beyond_m,
      "m",
      "the mesh farther from the newest keyframe is final and goes to the disk, its rays are "
      "forgotten; at least max_range_m; 0: never",
      kNotNegative);
  table->add("memory_budget_mib",
             &c->memory_budget_mb,
             "MiB",
             "above this memory of the map max_range_m and frozen_beyond_m shrink; 0: no limit",
             kNotNegative);
  table->add_check([c]() -> std::string {
    return c->min_range_m < c->max_range_m ? "" : "'min_range_m' must be below 'max_range_m'";
  });
  table->add_check([c]() -> std::string {
    return c->frozen_beyond_m == 0.0 || c->frozen_beyond_m >= c->max_range_m
               ? ""
               : "'frozen_beyond_m' must be 0 (never) or at least 'max_range_m'";
  });
}

}  // namespace

ParameterTable parameter_table(MapperNodeConfig* config) {
  ParameterTable table;
  table.add("point_topics",
            &config->point_topics,
            "clouds to map: sensor_msgs/PointCloud2 with x y z [label] [sigma]");
  add_label_file(&table, &config->label_file);
  add_pose(&table, &config->pose);
  table.add("queue_size",
            &config->queue_size,
            "frames",
            "frames that may wait for the map; further ones are dropped and counted",
            {1, 100000});
  table.add("update_period_s",
            &config->update_period_s,
            "s",
            "least wall time between two updates of the surface",
            kNotNegative);
  add_map(&table, &config->map);
  table.add(
      "archive_folder",
      &config->archive_folder,
      "frozen chunks are kept in a folder made here and removed at the end; empty: the system's "
      "temporary folder");
  table.add("corrected_frame",
            &config->corrected_frame,
            "frame whose poses come on keyframe_poses (base_link, say), attached to the sensors by "
            "tf; empty: the sensor's own frame");
  add_cloud(&table, &config->cloud);
  add_carving(&table, &config->map.carving);
  add_output(&table, &config->output);
  table.add_check([config]() -> std::string {
    return config->point_topics.empty() ? "'point_topics' is empty; name at least one topic" : "";
  });
  return table;
}

}  // namespace facet_mapping
