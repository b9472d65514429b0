// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_checks.h"

#include <cmath>

#include "rules.h"

namespace facet_mapping::detail {
namespace {

bool is_positive(double value) {
  return value > 0.0 && std::isfinite(value);
}
bool is_share(double value) {
  return value >= 0.0 && value <= 1.0;
}

void require_sweep(const SweepConfig& config, Rules* rules) {
  rules->require(config.sweep_width_px >= 64, "sweep_width_px must be at least 64");
  rules->require(config.window >= 1 && config.window <= 20, "window must be from 1 to 20");
  rules->require(is_positive(config.min_motion), "min_motion must be positive");
  rules->require(config.max_parallax_deg > 0.0 && config.max_parallax_deg < 180.0,
                 "max_parallax_deg must be above 0 and below 180");
  rules->require(config.plane_step_px >= 0.1 && config.plane_step_px <= 10.0,
                 "plane_step_px must be from 0.1 to 10");
  rules->require(config.max_planes >= 8 && config.max_planes <= 1024,
                 "max_planes must be from 8 to 1024");
  rules->require(config.max_directions >= 0 && config.max_directions <= 16,
                 "max_directions must be from 0 to 16");
}

void require_points(const SweepConfig& config, Rules* rules) {
  rules->require(is_share(config.min_uniqueness), "min_uniqueness must be from 0 to 1");
  rules->require(is_share(config.min_likeness), "min_likeness must be from 0 to 1");
  rules->require(config.min_agreeing >= 0, "min_agreeing must not be negative");
  rules->require(is_positive(config.max_disagreement_px), "max_disagreement_px must be positive");
  rules->require(is_positive(config.pixel_sigma), "pixel_sigma must be positive");
  rules->require(config.max_relative_sigma > 0.0, "max_relative_sigma must be positive");
  rules->require(config.min_depth_m > 0.0 && config.max_depth_m > config.min_depth_m &&
                     std::isfinite(config.max_depth_m),
                 "min_depth_m must be above 0 and below max_depth_m, which must be finite");
  rules->require(config.cell_px > 0, "cell_px must be positive");
  rules->require(config.flat_cell_px >= config.cell_px, "flat_cell_px must be at least cell_px");
  rules->require(config.min_gradient >= 0.0, "min_gradient must not be negative");
}

}  // namespace

void check_sweep_config(const SweepConfig& config) {
  Rules rules;
  require_sweep(config, &rules);
  require_points(config, &rules);
  rules.throw_if_broken("The configuration of the plane sweep is not usable: ");
}

}  // namespace facet_mapping::detail
