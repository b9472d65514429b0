// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Poses from the GPS/IMU packets of KITTI raw drives.
#pragma once

#include <string>
#include <vector>

#include "problems.h"
#include <Eigen/Geometry>

namespace facet_mapping {

/// world_from_imu of each packet file `folder`/NAME.txt (world: x east, y north, z up, metres), by
/// the Mercator projection at the latitude of the first packet, as the drives' own development kit
/// does it. Missing or wrong files are added to the problems.
std::vector<Eigen::Isometry3d> read_oxts(const std::string& folder,
                                         const std::vector<std::string>& names,
                                         Problems& problems);

}  // namespace facet_mapping
