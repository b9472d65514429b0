// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

namespace facet_mapping {
namespace {

void add_features(ParameterTable* table, TrackConfig* c) {
  table->add("tracks/corner_cell_px",
             &c->corner_cell_px,
             "px",
             "corners keep this distance from each other",
             {1, 1000});
  table->add("tracks/edge_cell_px",
             &c->edge_cell_px,
             "px",
             "at most one new edge point per cell of this size",
             {1, 1000});
  table->add("tracks/min_corner",
             &c->min_corner,
             "",
             "weakest corner against the strongest",
             {kSmallestPositive, 1.0});
  table->add("tracks/min_gradient",
             &c->min_gradient,
             "1/px",
             "weakest edge, 8-bit units per pixel",
             kPositive);
}

void add_matching(ParameterTable* table, TrackConfig* c) {
  table->add("tracks/patch_radius_px",
             &c->patch_radius_px,
             "px",
             "patches are squares of 2 * radius + 1 pixels",
             {1, 15});
  table->add("tracks/min_likeness",
             &c->min_likeness,
             "",
             "least normalised cross-correlation of a match",
             kUnit);
  table->add("tracks/min_uniqueness",
             &c->min_uniqueness,
             "",
             "the second-best match must be less like by this",
             kUnit);
  table->add("tracks/epipolar_tolerance_px",
             &c->epipolar_tolerance_px,
             "px",
             "farther from its epipolar line a match is no match",
             kPositive);
  table->add("tracks/round_trip_px",
             &c->round_trip_px,
             "px",
             "matching back must end this near to the start",
             kPositive);
  table->add("tracks/min_motion_px",
             &c->min_motion_px,
             "px",
             "images with a smaller median parallax are not used",
             kNotNegative);
}

void add_points(ParameterTable* table, TrackConfig* c) {
  table->add("tracks/min_observations",
             &c->min_observations,
             "images",
             "images that must have seen a point",
             {2, 1000});
  table->add("tracks/window",
             &c->window,
             "images",
             "used images that a used image waits for before its points are out",
             {1, 1000});
  table->add("tracks/pixel_sigma",
             &c->pixel_sigma,
             "px",
             "noise of a match, which a point's sigma comes from",
             kPositive);
  table->add("tracks/max_reprojection_px",
             &c->max_reprojection_px,
             "px",
             "larger root mean square of a track's residuals: dropped",
             kPositive);
  table->add("tracks/min_parallax_deg",
             &c->min_parallax_deg,
             "deg",
             "smallest angle between the outermost rays to a point",
             {0.0, 179.0});
  table->add("tracks/max_relative_sigma",
             &c->max_relative_sigma,
             "",
             "points with sigma / depth above this are dropped",
             kPositive);
  table->add("tracks/min_depth_m", &c->min_depth_m, "m", "nearer points are dropped", kPositive);
  table->add("tracks/max_depth_m", &c->max_depth_m, "m", "farther points are dropped", kPositive);
  table->add_check([c]() -> std::string {
    return c->min_depth_m < c->max_depth_m
               ? ""
               : "'tracks/min_depth_m' must be below 'tracks/max_depth_m'";
  });
}

}  // namespace

ParameterTable parameter_table(TrackPointsNodeConfig* config) {
  ParameterTable table;
  add_moving_camera(&table, &config->input);
  add_features(&table, &config->tracks);
  add_matching(&table, &config->tracks);
  add_points(&table, &config->tracks);
  return table;
}

}  // namespace facet_mapping
