// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two facets of a mesh: do they cross?
#pragma once

#include <cstdint>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// A facet whose corners lie on one line, exactly.
bool is_degenerate(const TriangleMesh& mesh, std::uint32_t facet);

/// Have the two facets more in common than the corners that they share? Exact. Neither may be
/// degenerate.
bool facets_cross(const TriangleMesh& mesh, std::uint32_t f, std::uint32_t g);

}  // namespace facet_mapping
