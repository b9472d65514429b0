// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a street that a camera may see.
#pragma once

#include <vector>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/render/facet_renderer.h"
#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

/// Indices of the parts whose bounding sphere meets the view's frustum within `far` metres.
std::vector<std::size_t> parts_in_view(const Street& street, const View& view, double far);

/// Renders the named parts alone; facets are numbered as in the street's mesh.
FacetImage render_parts(const Street& street,
                        const std::vector<std::size_t>& parts,
                        const View& view);

}  // namespace facet_mapping
