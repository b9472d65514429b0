// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the window shows of labelled meshes, in the words of a request.
#pragma once

#include <optional>
#include <vector>

#include <facet_mapping/BoxRegion.h>
#include <rviz/display_context.h>

#include "facet_mapping/rviz/class_table.h"

namespace facet_mapping {

/// Around all chunks that the present view sees, in the frame of the first mesh of which it sees
/// any; meshes of other frames do not count. Nothing if the view sees none.
std::optional<BoxRegion> region_in_view(const rviz::DisplayContext& context);

/// The classes of all shown meshes.
std::vector<ClassStyle> shown_classes(const rviz::DisplayContext& context);

}  // namespace facet_mapping
