// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a building is made of.
#pragma once

#include "random.h"
#include "scene_builder.h"

namespace facet_mapping {

/// Lengths in metres.
struct BuildingStyle {
  double floor_height;
  double sill_height;
  double window_width;
  double window_height;
  int floors;
  int bays;
  int door_bay;
  bool pitched;
  bool ledge;  // a band of stone over the ground floor
  Surface wall;
  Surface window;
  Surface door;
  Surface trim;
  Surface roof;
};

/// Draws a style for a facade of the given width and adds its materials.
BuildingStyle draw_building_style(SceneBuilder* builder, double width, Random* random);

}  // namespace facet_mapping
