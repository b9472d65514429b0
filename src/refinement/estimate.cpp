// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cmath>

#include "refinement_run.h"

namespace facet_mapping {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Pixels of all levels, in pixels of the finest.
double pixel_share(int levels) {
  return (1.0 - std::pow(0.25, levels)) / 0.75;
}

}  // namespace

RefinementEstimate RefinementRun::estimate() {
  // Fitted to the fountain and a street, coarse and fine starts, all semantic modes.
  constexpr double kMeasuresPerLevel = 0.8;
  constexpr double kMeasuresPerIteration = 0.8;
  constexpr double kSplitsPerLevel = 1.0;
  RefinementEstimate estimate;
  estimate.views = views_.size();
  const auto start = std::chrono::steady_clock::now();
  begin();
  estimate.energy = measure(current_, 0).terms;
  const double measure_s = seconds_since(start);
  const auto split_start = std::chrono::steady_clock::now();
  if (config_.iterations > 0) {
    split_facets(finest_);
  }
  const double split_s = seconds_since(split_start);
  estimate.facets = current_.triangles.size();
  estimate.measured_s = seconds_since(start);
  const double per_level = kMeasuresPerLevel * measure_s + kSplitsPerLevel * split_s;
  const double iterating =
      config_.iterations * pixel_share(config_.levels) * kMeasuresPerIteration * measure_s;
  estimate.seconds = 2.0 * measure_s + config_.levels * per_level + iterating + split_s;
  return estimate;
}

}  // namespace facet_mapping
