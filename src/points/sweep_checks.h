// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contracts of the plane sweeper.
#pragma once

#include "facet_mapping/points/sweep_points.h"

namespace facet_mapping::detail {

/// Throws std::invalid_argument that names everything that is wrong.
void check_sweep_config(const SweepConfig& config);

}  // namespace facet_mapping::detail
