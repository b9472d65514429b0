// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The timestamps.txt of KITTI raw drives.
#pragma once

#include <string>
#include <vector>

#include "problems.h"

namespace facet_mapping {

/// Seconds since the first line; its Unix time (UTC) goes to `epoch`. Problems: a missing file, a
/// line that is no "2011-09-26 13:02:25.964389445", times that do not grow.
std::vector<double> read_timestamps(const std::string& path, double& epoch, Problems& problems);

}  // namespace facet_mapping
