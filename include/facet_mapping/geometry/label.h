// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The type of a semantic class id, shared by pixels, points, cells and facets.
#pragma once

#include <cstdint>

namespace facet_mapping {

using Label = std::uint16_t;

/// "No class is known": such a ray carves but adds no label, such a facet shows no class.
constexpr Label kUnlabelled = 65535;

}  // namespace facet_mapping
