// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shown_meshes.h"

#include "labeled_mesh_display.h"
#include <rviz/display_group.h>

namespace facet_mapping {
namespace {

void collect(rviz::DisplayGroup* group, std::vector<LabeledMeshDisplay*>* found) {
  for (int k = 0; k < group->numDisplays(); ++k) {
    rviz::Display* display = group->getDisplayAt(k);
    if (!display->isEnabled()) {
      continue;
    }
    if (auto* mesh = qobject_cast<LabeledMeshDisplay*>(display)) {
      found->push_back(mesh);
    } else if (auto* inner = qobject_cast<rviz::DisplayGroup*>(display)) {
      collect(inner, found);
    }
  }
}

}  // namespace

std::vector<LabeledMeshDisplay*> shown_meshes(const rviz::DisplayContext& context) {
  std::vector<LabeledMeshDisplay*> found;
  collect(context.getRootDisplayGroup(), &found);
  return found;
}

}  // namespace facet_mapping
