// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packets and partial scans gathered into frames.
#pragma once

#include <optional>
#include <vector>

#include "facet_mapping/points/lidar_scan.h"

namespace facet_mapping {

/// Scans go into one frame until it spans `frame_s` seconds. The frame's stamp is that of the scan
/// nearest to the frame's middle, so that its origin and its camera image are near to all points.
class ScanAccumulator {
 public:
  /// `frame_s` 0: every scan is a frame. Throws std::invalid_argument if negative or not finite.
  explicit ScanAccumulator(double frame_s = 0.0);

  /// The frame before `scan`, if it is complete without it. A scan that is older than the one
  /// before, or starts later than a whole frame after it, completes the frame, too.
  /// Throws std::invalid_argument if offsets and points differ in number.
  std::optional<LidarScan> add(LidarScan scan);
  /// What has been gathered, if anything.
  std::optional<LidarScan> finish();
  void clear() { scans_.clear(); }

 private:
  double frame_s_;
  std::vector<LidarScan> scans_;
};

}  // namespace facet_mapping
