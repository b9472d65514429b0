// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A LiDAR scan whose points were measured one after the other, and what drivers say about when.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping {

struct LidarScan {
  double stamp = 0.0;  ///< seconds; the reference of the offsets
  /// Metres, each in the frame that the sensor had when it measured the point.
  std::vector<Eigen::Vector3f> points;
  /// Seconds after `stamp` (before it: negative), one per point; not finite: unknown. Empty: all
  /// points were measured at `stamp`.
  std::vector<double> offsets_s;
};

enum class TimeUnit { kSeconds, kMilliseconds, kMicroseconds, kNanoseconds };

double seconds_per(TimeUnit unit);
/// "s", "ms", "us" or "ns".
std::string name_of(TimeUnit unit);

struct PointTimeConfig {
  std::optional<TimeUnit> unit;              ///< none: found from the times' spread
  TimeUnit usual_unit = TimeUnit::kSeconds;  ///< tried first where `unit` is none
  bool usually_absolute = false;  ///< times of day rather than times since the stamp, if both fit
  double max_scan_s = 0.5;  ///< a scan lasts no longer, and its stamp is as near to its points
};

struct PointTimes {
  std::vector<double> offsets_s;  ///< as in LidarScan
  TimeUnit unit = TimeUnit::kSeconds;
  bool absolute = false;     ///< the times were on the clock of the stamp, not relative to it
  bool constant = false;     ///< all times are the same: nothing to compensate
  std::size_t unusable = 0;  ///< times that are not finite, or too far from all others
};

/// Offsets of the points from the times that a driver gives (any order). Units and references
/// differ between drivers (s after the stamp: Velodyne; ns after it: Ouster, Livox; Unix time in s
/// or ns: Hesai, RoboSense, Livox), so the usual unit is taken if a scan could last that long, else
/// the coarsest in which it could. Throws std::invalid_argument with a sentence if the
/// times fit no unit, lie on another clock than the stamp, or are unusable for more than half of
/// the points.
PointTimes point_times(const std::vector<double>& raw,
                       double stamp,
                       const PointTimeConfig& config = {});

}  // namespace facet_mapping
