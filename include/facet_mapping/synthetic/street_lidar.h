// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A spinning LiDAR in the street; the forward sector of its scans.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/synthetic/street.h"
#include "facet_mapping/synthetic/street_raycaster.h"

namespace facet_mapping {

struct StreetLidarConfig {
  int beams = 64;                 ///< evenly from `lowest_deg` to `highest_deg`
  double lowest_deg = -24.8;      ///< elevation of the lowest beam
  double highest_deg = 2.0;       ///< elevation of the highest beam
  double half_sector_deg = 50.0;  ///< azimuth kept to either side of straight ahead
  double azimuth_step_deg = 0.2;  ///< between two shots of a beam
  double max_range_m = 100.0;     ///< farther surfaces give no return
  double range_sigma_m = 0.02;    ///< standard deviation along the beam
  double dropout = 0.02;          ///< share of the returns that is lost anywhere
  double glass_dropout = 0.5;     ///< share lost on windows
};

/// Throws std::invalid_argument if the configuration is out of range.
void check(const StreetLidarConfig& config);

/// x y z (metres, LiDAR frame: x forward, z up) and intensity (0 .. 1), beam by beam. The whole
/// scan is taken at one instant. Same seed, same scan, whatever the number of threads.
std::vector<Eigen::Vector4f> scan_street(const Street& street,
                                         const StreetRaycaster& raycaster,
                                         const Eigen::Isometry3d& map_from_velo,
                                         const StreetLidarConfig& config,
                                         std::uint64_t seed);

}  // namespace facet_mapping
