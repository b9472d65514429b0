// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How tools and panels find the displays of labelled meshes.
#pragma once

#include <vector>

#include <rviz/display_context.h>

namespace facet_mapping {

class LabeledMeshDisplay;

/// The enabled ones, in the order of the window's tree, groups included.
std::vector<LabeledMeshDisplay*> shown_meshes(const rviz::DisplayContext& context);

}  // namespace facet_mapping
