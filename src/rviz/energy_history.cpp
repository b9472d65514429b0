// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/energy_history.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace facet_mapping {
namespace {

/// The least 1, 2 or 5 times a power of ten that is not below `least`.
double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  constexpr double kSlack = 1.0 + 1e-9;  // rounding must not make 2 a little more than 2
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * kSlack >= least) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

PlotAxis axis_with_step(double low, double high, double step) {
  PlotAxis axis;
  axis.step = step;
  axis.low = std::floor(low / step) * step;
  axis.high = std::ceil(high / step) * step;
  return axis;
}

}  // namespace

bool EnergyHistory::add(const RefineProgress& sample) {
  const bool is_new = samples_.empty() || sample.fraction <= samples_.back().fraction ||
                      sample.seconds < samples_.back().seconds;
  if (is_new) {
    samples_.clear();
  }
  samples_.push_back(sample);
  return is_new;
}

std::vector<EnergyHistory::Stretch> EnergyHistory::levels() const {
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    if (stretches.empty() || stretches.back().level != samples_[k].level) {
      stretches.push_back({samples_[k].level, k, k});
    }
    stretches.back().end = k + 1;
  }
  return stretches;
}

std::size_t EnergyHistory::places() const {
  constexpr std::size_t kFew = 10;
  const std::size_t count = samples_.size();
  const std::size_t most = std::max(kFew, 2 * count);
  const double fraction = samples_.empty() ? 0.0 : samples_.back().fraction;
  if (!(fraction * static_cast<double>(most) > static_cast<double>(count))) {
    return most;
  }
  return std::max(count,
                  static_cast<std::size_t>(std::lround(static_cast<double>(count) / fraction)));
}

std::string PlotAxis::text(double value) const {
  const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  char buffer[64];
  std::snprintf(buffer, sizeof(buffer), "%.*f", digits, value);
  return buffer;
}

PlotAxis axis_over(const std::vector<double>& values, int max_steps) {
  double low = INFINITY;
  double high = -INFINITY;
  for (const double value : values) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high) {
    return {};
  }
  // Values that hardly differ are no reason to show rounding errors.
  const double least_range = std::max(1e-6, 1e-3 * std::max(std::abs(low), std::abs(high)));
  const double range = std::max(high - low, least_range);
  double step = nice_step(range / max_steps);
  PlotAxis axis = axis_with_step(low, low + range, step);
  while (axis.high - axis.low > (max_steps + 0.5) * step) {  // both ends were rounded outwards
    step = nice_step(1.5 * step);
    axis = axis_with_step(low, low + range, step);
  }
  return axis;
}

}  // namespace facet_mapping
