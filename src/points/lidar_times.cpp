// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "rules.h"

#include "facet_mapping/points/lidar_scan.h"

namespace facet_mapping {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kShortestS = 2e-4;  // of a packet; a shorter one was read in too fine a unit

/// Of the finite times, so that a quarter of rubbish at either end does not matter.
struct Spread {
  double median = 0.0;
  double width = 0.0;  // twice the distance of the quartiles: the length of an even scan
  bool constant = true;
};

struct Reading {
  TimeUnit unit = TimeUnit::kSeconds;
  bool absolute = false;
};

Spread spread_of(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  return {at(0.5), 2.0 * (at(0.75) - at(0.25)), times.front() == times.back()};
}

std::vector<TimeUnit> candidates(const PointTimeConfig& config) {
  if (config.unit) {
    return {*config.unit};
  }
  return {config.usual_unit,
          TimeUnit::kSeconds,
          TimeUnit::kMilliseconds,
          TimeUnit::kMicroseconds,
          TimeUnit::kNanoseconds};
}

bool fits(const Spread& spread,
          const Reading& reading,
          double stamp,
          double shortest_s,
          const PointTimeConfig& config) {
  const double scale = seconds_per(reading.unit);
  const double center = spread.median * scale - (reading.absolute ? stamp : 0.0);
  const double width = spread.width * scale;
  return width >= shortest_s && width <= config.max_scan_s && std::abs(center) <= config.max_scan_s;
}

/// Tried in the order of what drivers do; too short a scan only in the unit that is known or usual.
std::optional<Reading> read_as(const Spread& spread, double stamp, const PointTimeConfig& config) {
  for (const bool absolute : {config.usually_absolute, !config.usually_absolute}) {
    for (const TimeUnit unit : candidates(config)) {
      if (fits(spread, {unit, absolute}, stamp, kShortestS, config)) {
        return Reading{unit, absolute};
      }
    }
  }
  const TimeUnit unit = config.unit.value_or(config.usual_unit);
  for (const bool absolute : {config.usually_absolute, !config.usually_absolute}) {
    if (fits(spread, {unit, absolute}, stamp, 0.0, config)) {
      return Reading{unit, absolute};
    }
  }
  return std::nullopt;
}

std::invalid_argument no_reading(const Spread& spread,
                                 double stamp,
                                 const PointTimeConfig& config) {
  std::ostringstream text;
  text.precision(15);
  text << "The point times (half of them around " << spread.median << ", spread over about "
       << spread.width << ") are neither times after the scan's stamp nor on its clock (" << stamp
       << " s)";
  if (config.unit) {
    text << " in " << name_of(*config.unit);
  }
  text << " for a scan of at most " << config.max_scan_s
       << " s: stamp scans and points by one clock, or state the unit or that there are no times";
  return std::invalid_argument(text.str());
}

}  // namespace

double seconds_per(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kMilliseconds:
      return 1e-3;
    case TimeUnit::kMicroseconds:
      return 1e-6;
    case TimeUnit::kNanoseconds:
      return 1e-9;
    default:
      return 1.0;
  }
}

std::string name_of(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kMilliseconds:
      return "ms";
    case TimeUnit::kMicroseconds:
      return "us";
    case TimeUnit::kNanoseconds:
      return "ns";
    default:
      return "s";
  }
}

PointTimes point_times(const std::vector<double>& raw,
                       double stamp,
                       const PointTimeConfig& config) {
  detail::Rules rules;
  rules.require(std::isfinite(stamp), "the stamp must be finite");
  rules.require(config.max_scan_s > 0.0 && std::isfinite(config.max_scan_s),
                "max_scan_s must be positive");
  rules.throw_if_broken("Point times cannot be read: ");
  PointTimes times;
  if (raw.empty()) {
    return times;
  }
  std::vector<double> finite;
  std::copy_if(raw.begin(), raw.end(), std::back_inserter(finite), [](double t) {
    return std::isfinite(t);
  });
  if (2 * finite.size() < raw.size()) {
    throw std::invalid_argument("Only " + std::to_string(finite.size()) + " of " +
                                std::to_string(raw.size()) +
                                " point times are finite; state that there are no times");
  }
  const Spread spread = spread_of(std::move(finite));
  const std::optional<Reading> reading = read_as(spread, stamp, config);
  if (!reading) {
    throw no_reading(spread, stamp, config);
  }
  times.unit = reading->unit;
  times.absolute = reading->absolute;
  times.constant = spread.constant;
  const double scale = seconds_per(reading->unit);
  times.offsets_s.reserve(raw.size());
  for (const double time : raw) {
    const bool usable = std::abs(time - spread.median) * scale <= config.max_scan_s;
    times.offsets_s.push_back(usable ? time * scale - (reading->absolute ? stamp : 0.0) : kNan);
    times.unusable += usable ? 0 : 1;
  }
  if (2 * times.unusable > raw.size()) {
    throw no_reading(spread, stamp, config);
  }
  return times;
}

}  // namespace facet_mapping
