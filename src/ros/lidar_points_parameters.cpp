// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

#include "facet_mapping/ros/lidar_points_node_config.h"

namespace facet_mapping {
namespace {

void add_motion(ParameterTable* table, LidarPointsNodeConfig* c) {
  table->add("time_field",
             &c->time.field,
             "field with each point's time of measurement; auto: `time`, `t`, `offset_time`, "
             "`time_offset` or `timestamp`, whichever there is; none: a cloud is of one instant");
  table->add_choice<std::optional<TimeUnit>>("time_unit",
                                             &c->time.unit,
                                             {{"auto", std::nullopt},
                                              {"s", TimeUnit::kSeconds},
                                              {"ms", TimeUnit::kMilliseconds},
                                              {"us", TimeUnit::kMicroseconds},
                                              {"ns", TimeUnit::kNanoseconds}},
                                             "unit of these times; auto: by field and spread");
  table->add("max_scan_s",
             &c->time.max_scan_s,
             "s",
             "longest scan; times farther from the cloud's stamp are refused",
             {kSmallestPositive, 100.0});
  table->add("frame_s",
             &c->frame_s,
             "s",
             "clouds (packets, partial scans) are gathered into frames this long; 0: each is one",
             {0.0, 100.0});
  table->add(
      "split_m",
      &c->split_m,
      "m",
      "a scan during which the sensor moved farther is cut into parts, each with a stamp and "
      "origin of its own; at least twice the mapper's keyframe_translation_m, or it skips "
      "parts; 0: never",
      kNotNegative);
  table->add("pose_step_s",
             &c->pose_step_s,
             "s",
             "motion is compensated by poses of tf this far apart",
             {1e-4, 1.0});
  table->add("max_extrapolation_s",
             &c->max_extrapolation_s,
             "s",
             "motion that tf does not know yet may be carried on this long",
             {0.0, 1.0});
}

void add_cloud(ParameterTable* table, CloudConfig* c) {
  table->add("min_range_m",
             &c->min_range_m,
             "m",
             "nearer points (the vehicle itself) are dropped",
             kNotNegative);
  table->add(
      "max_range_m", &c->max_range_m, "m", "farther points are dropped", {kSmallestPositive, 1e4});
  table->add("voxel_m",
             &c->voxel_m,
             "m",
             "at most one (measured) point per cube of this size, at least 0.01; 0: all",
             {0.0, 1e4});
  table->add("outlier_radius_m",
             &c->outlier_radius_m,
             "m",
             "points with too few others in this radius are dropped; 0: off",
             kNotNegative);
  table->add(
      "outlier_neighbors", &c->outlier_neighbors, "", "fewest others in that radius", {0, 1000});
  table->add("sigma_m",
             &c->sigma_m,
             "m",
             "standard deviation of the measured range, handed on",
             kNotNegative);
  table->add_check([c]() -> std::string {
    return c->min_range_m < c->max_range_m ? "" : "'min_range_m' must be below 'max_range_m'";
  });
  table->add_check([c]() -> std::string {
    return c->voxel_m == 0.0 || c->voxel_m >= 0.01 ? "" : "'voxel_m' must be 0 or at least 0.01";
  });
}

void add_occlusion(ParameterTable* table, LidarPointsNodeConfig* c) {
  table->add("occluder_px",
             &c->labels.occluder_px,
             "px",
             "nearer points on two opposite sides, this near in the image, hide a point from the "
             "camera: at least the distance of two scan lines",
             {0, 100});
  table->add("edge_px",
             &c->labels.edge_px,
             "px",
             "so do those on one side, this near, unless the point's surface goes on from them",
             {0, 100});
  table->add("occlusion_margin",
             &c->labels.occlusion_margin,
             "",
             "nearer means by more than this share of the depth",
             kNotNegative);
  table->add(
      "occluder_scans",
      &c->occluder_scans,
      "scans",
      "the newest scans whose points hide others: more fill the gaps between scan lines, but "
      "what moved hides also where it was",
      {1, 100});
}

}  // namespace

ParameterTable parameter_table(LidarPointsNodeConfig* config) {
  ParameterTable table;
  add_segmentation(&table, &config->segmentation);
  table.add("segmentation_tolerance_s",
            &config->segmentation_tolerance_s,
            "s",
            "a scan takes its classes from the label image nearest to it in time, within this",
            kNotNegative);
  add_pose(&table, &config->pose);
  table.add("queue_size",
            &config->queue_size,
            "scans",
            "scans that may wait for their label image, and as many for the work; then one is "
            "dropped and counted",
            {1, 100000});
  add_motion(&table, config);
  add_cloud(&table, &config->cloud);
  add_occlusion(&table, config);
  return table;
}

}  // namespace facet_mapping
