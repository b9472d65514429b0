// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/lidar_accumulator.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace facet_mapping {
namespace {

/// The scan whose stamp is nearest to the middle of all.
double middle_stamp(const std::vector<LidarScan>& scans) {
  const double middle = 0.5 * (scans.front().stamp + scans.back().stamp);
  double best = scans.front().stamp;
  for (const LidarScan& scan : scans) {
    if (std::abs(scan.stamp - middle) < std::abs(best - middle)) {
      best = scan.stamp;
    }
  }
  return best;
}

void append(const LidarScan& scan, LidarScan* frame) {
  frame->points.insert(frame->points.end(), scan.points.begin(), scan.points.end());
  const double shift_s = scan.stamp - frame->stamp;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    frame->offsets_s.push_back(shift_s + (scan.offsets_s.empty() ? 0.0 : scan.offsets_s[i]));
  }
}

}  // namespace

ScanAccumulator::ScanAccumulator(double frame_s) : frame_s_(frame_s) {
  if (!(frame_s >= 0.0 && std::isfinite(frame_s))) {
    throw std::invalid_argument("A frame's length must not be negative, nor infinite");
  }
}

std::optional<LidarScan> ScanAccumulator::add(LidarScan scan) {
  if (!scan.offsets_s.empty() && scan.offsets_s.size() != scan.points.size()) {
    throw std::invalid_argument("A scan has " + std::to_string(scan.offsets_s.size()) +
                                " time offsets for " + std::to_string(scan.points.size()) +
                                " points");
  }
  if (frame_s_ == 0.0) {
    return scan;
  }
  constexpr double kJitterS = 1e-4;  // of stamps that are whole multiples of the frame's length
  const bool completes =
      !scans_.empty() &&
      (scan.stamp - scans_.front().stamp > frame_s_ - kJitterS || scan.stamp < scans_.back().stamp);
  std::optional<LidarScan> frame = completes ? finish() : std::nullopt;
  scans_.push_back(std::move(scan));
  return frame;
}

std::optional<LidarScan> ScanAccumulator::finish() {
  if (scans_.empty()) {
    return std::nullopt;
  }
  if (scans_.size() == 1) {
    std::optional<LidarScan> only(std::move(scans_.front()));
    scans_.clear();
    return only;
  }
  LidarScan frame;
  frame.stamp = middle_stamp(scans_);
  for (const LidarScan& scan : scans_) {
    append(scan, &frame);
  }
  scans_.clear();
  return frame;
}

}  // namespace facet_mapping
