// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

namespace facet_mapping {
namespace {

void add_sweep_planes(ParameterTable* table, SweepConfig* c) {
  table->add("sweep/sweep_width_px",
             &c->sweep_width_px,
             "px",
             "wider images are swept at 1/2, 1/4 ... of their size, then refined",
             {64, 100000});
  table->add("sweep/window",
             &c->window,
             "images",
             "used images before and after that a used image is compared with",
             {1, 20});
  table->add(
      "sweep/min_motion",
      &c->min_motion,
      "",
      "images that moved less since the last used one (share of the median depth) are not used",
      {kSmallestPositive, 100.0});
  table->add("sweep/max_parallax_deg",
             &c->max_parallax_deg,
             "deg",
             "images seen under a larger angle are not compared",
             {kSmallestPositive, 179.0});
  table->add("sweep/plane_step_px",
             &c->plane_step_px,
             "px",
             "most motion of a pixel from a plane to the next, pixels as swept",
             {0.1, 10.0});
  table->add("sweep/max_planes",
             &c->max_planes,
             "planes",
             "of one direction; the step grows where more would be needed",
             {8, 1024});
  table->add(
      "sweep/max_directions",
      &c->max_directions,
      "",
      "directions of the scene (ground, facades) swept besides the planes that face the camera",
      {0, 16});
}

void add_sweep_checks(ParameterTable* table, SweepConfig* c) {
  table->add("sweep/min_uniqueness",
             &c->min_uniqueness,
             "",
             "the second-best cost must be larger by this share",
             kUnit);
  table->add("sweep/min_likeness",
             &c->min_likeness,
             "",
             "least normalised cross-correlation at full size",
             kUnit);
  table->add("sweep/min_agreeing",
             &c->min_agreeing,
             "images",
             "depths of other used images that must agree with a point",
             {0, 1000});
  table->add("sweep/max_disagreement_px",
             &c->max_disagreement_px,
             "px",
             "... to within this motion between the images",
             kPositive);
  table->add("sweep/pixel_sigma",
             &c->pixel_sigma,
             "px",
             "noise of a match, which sigma comes from",
             kPositive);
  table->add("sweep/max_relative_sigma",
             &c->max_relative_sigma,
             "",
             "points with sigma / depth above this are dropped",
             kPositive);
}

void add_sweep_points(ParameterTable* table, SweepConfig* c) {
  table->add("sweep/min_depth_m", &c->min_depth_m, "m", "nearer points are dropped", kPositive);
  table->add("sweep/max_depth_m", &c->max_depth_m, "m", "farther points are dropped", kPositive);
  table->add(
      "sweep/cell_px", &c->cell_px, "px", "at most one point per cell of this size", {1, 1000});
  table->add("sweep/min_gradient",
             &c->min_gradient,
             "1/px",
             "least image gradient (8-bit units per pixel) of such a point",
             kNotNegative);
  table->add("sweep/flat_cell_px",
             &c->flat_cell_px,
             "px",
             "cell size where no pixel reaches min_gradient",
             {1, 1000});
  table->add_check([c]() -> std::string {
    return c->min_depth_m < c->max_depth_m
               ? ""
               : "'sweep/min_depth_m' must be below 'sweep/max_depth_m'";
  });
  table->add_check([c]() -> std::string {
    return c->cell_px <= c->flat_cell_px ? ""
                                         : "'sweep/flat_cell_px' must be at least 'sweep/cell_px'";
  });
}

}  // namespace

ParameterTable parameter_table(SweepPointsNodeConfig* config) {
  ParameterTable table;
  add_moving_camera(&table, &config->input);
  add_sweep_planes(&table, &config->sweep);
  add_sweep_checks(&table, &config->sweep);
  add_sweep_points(&table, &config->sweep);
  return table;
}

}  // namespace facet_mapping
