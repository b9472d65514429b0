// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_parameters.h"

namespace facet_mapping {
namespace {

void add_stereo(ParameterTable* table, StereoConfig* c) {
  table->add("stereo/num_disparities",
             &c->num_disparities,
             "px",
             "search range, a multiple of 16",
             {16, 1024});
  table->add("stereo/block_size", &c->block_size, "px", "matching window, odd", {1, 11});
  table->add("stereo/uniqueness_percent",
             &c->uniqueness_percent,
             "%",
             "margin of the best over the second-best cost",
             {0, 100});
  table->add("stereo/left_right_tolerance_px",
             &c->left_right_tolerance_px,
             "px",
             "largest disagreement of the two matching directions",
             {0.0, 100.0});
  table->add("stereo/speckle_size_px",
             &c->speckle_size_px,
             "px",
             "smaller regions of similar disparity are dropped",
             {0, 1e6});
  table->add("stereo/edge_jump_px",
             &c->edge_jump_px,
             "px",
             "neighbours whose disparities differ more are a depth edge",
             kPositive);
  table->add("stereo/edge_margin_px",
             &c->edge_margin_px,
             "px",
             "pixels so near to a depth edge or a hole are dropped",
             {0, 100});
  table->add("stereo/disparity_sigma_px",
             &c->disparity_sigma_px,
             "px",
             "noise of a typical match; sigma is this times the doubt of each match",
             kPositive);
  table->add("stereo/max_relative_sigma",
             &c->max_relative_sigma,
             "",
             "points with sigma / depth above this are dropped",
             kPositive);
  table->add("stereo/min_depth_m", &c->min_depth_m, "m", "nearer points are dropped", kNotNegative);
  table->add("stereo/max_depth_m", &c->max_depth_m, "m", "farther points are dropped", kPositive);
  table->add(
      "stereo/cell_px", &c->cell_px, "px", "at most one point per cell of this size", {1, 1000});
  table->add("stereo/min_gradient",
             &c->min_gradient,
             "1/px",
             "least image gradient (8-bit units per pixel) of such a point",
             kNotNegative);
  table->add("stereo/flat_cell_px",
             &c->flat_cell_px,
             "px",
             "cell size where no pixel reaches min_gradient",
             {1, 1000});
  table->add_check([c]() -> std::string {
    return c->cell_px <= c->flat_cell_px
               ? ""
               : "'stereo/flat_cell_px' must be at least 'stereo/cell_px'";
  });
  table->add_check([c]() -> std::string {
    return c->num_disparities % 16 == 0 ? "" : "'stereo/num_disparities' must be a multiple of 16";
  });
  table->add_check([c]() -> std::string {
    return c->block_size % 2 == 1 ? "" : "'stereo/block_size' must be odd";
  });
  table->add_check([c]() -> std::string {
    return c->min_depth_m < c->max_depth_m
               ? ""
               : "'stereo/min_depth_m' must be below 'stereo/max_depth_m'";
  });
}

}  // namespace

ParameterTable parameter_table(StereoPointsNodeConfig* config) {
  ParameterTable table;
  add_segmentation(&table, &config->segmentation);
  table.add("queue_size",
            &config->queue_size,
            "pairs",
            "pairs that may wait for the matcher; further ones are dropped and counted",
            {1, 100000});
  add_stereo(&table, &config->stereo);
  table.add("sky/cell_px",
            &config->sky.cell_px,
            "px",
            "one carving ray per square of this size that is sky all over; 0: none",
            {0, 1000});
  table.add(
      "sky/range_m", &config->sky.range_m, "m", "where the rays toward the sky end", kPositive);
  return table;
}

}  // namespace facet_mapping
