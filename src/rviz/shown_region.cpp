// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shown_region.h"

#include <algorithm>
#include <string>

#include "labeled_mesh_display.h"
#include "shown_meshes.h"
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include "facet_mapping/rviz/refine_settings.h"

namespace facet_mapping {

std::optional<BoxRegion> region_in_view(const rviz::DisplayContext& context) {
  const rviz::ViewController* view = context.getViewManager()->getCurrent();
  if (view == nullptr) {
    return std::nullopt;
  }
  Eigen::AlignedBox3d box;
  std::string frame_id;
  for (const LabeledMeshDisplay* display : shown_meshes(context)) {
    const Eigen::AlignedBox3d seen = display->box_in_view(*view->getCamera());
    if (box.isEmpty()) {
      frame_id = display->store().frame_id();
    }
    if (display->store().frame_id() == frame_id) {
      box.extend(seen);
    }
  }
  return box.isEmpty() ? std::nullopt : std::make_optional(region_around(box, frame_id));
}

std::vector<ClassStyle> shown_classes(const rviz::DisplayContext& context) {
  std::vector<ClassStyle> classes;
  for (const LabeledMeshDisplay* display : shown_meshes(context)) {
    for (const ClassStyle& style : display->classes().styles()) {
      const bool is_known = std::any_of(
          classes.begin(), classes.end(), [&](const auto& other) { return other.id == style.id; });
      if (!is_known) {
        classes.push_back(style);
      }
    }
  }
  return classes;
}

}  // namespace facet_mapping
