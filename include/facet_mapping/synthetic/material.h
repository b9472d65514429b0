// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a facet of the synthetic street looks like: a procedural texture and its parameters.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace facet_mapping {

/// The meaning of a vertex's texture coordinates (metres) is given per kind; "solid" textures vary
/// in all three, the others draw their pattern in the first two.
enum class MaterialKind : std::uint8_t {
  kAsphalt,    ///< (along the street, across it, 0); size = (half road width, marking length)
  kKerb,       ///< (along, height or width, side)
  kPaving,     ///< (along, across, side); size = slab
  kGrass,      ///< (along, across, side)
  kBrick,      ///< (along the wall, height, depth); size = brick
  kPlaster,    ///< (along the wall, height, depth)
  kPanels,     ///< (along the wall, height, depth); size = panel
  kWindow,     ///< (from the left edge, from the lower edge, number); size = window
  kDoor,       ///< as kWindow
  kTrim,       ///< solid: sills, cornices, frames
  kRoofTiles,  ///< (along the eaves, up the slope, 0); size = tile
  kCarBody,    ///< the car's frame, scaled to the standard car (see scene_car.h)
  kWheel,      ///< (forward, up, outward) from the hub
  kMetal,      ///< solid
  kSign,       ///< (right, up, 0) from the middle; size = half extent
  kBark,       ///< solid
  kFoliage,    ///< solid
};

struct Material {
  MaterialKind kind = MaterialKind::kPlaster;
  Eigen::Vector3f color = Eigen::Vector3f::Constant(0.5F);   ///< linear reflectance, R G B
  Eigen::Vector3f accent = Eigen::Vector3f::Constant(0.5F);  ///< mortar, frame or second colour
  Eigen::Vector2f size = Eigen::Vector2f::Ones();            ///< metres, see MaterialKind
  std::uint32_t seed = 0;                                    ///< makes two materials differ
};

}  // namespace facet_mapping
