// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "building_style.h"

#include <algorithm>
#include <array>

namespace facet_mapping {
namespace {

Eigen::Vector3f wall_color(Random* random) {
  static const std::array<Eigen::Vector3f, 7> kColors{{{0.60F, 0.55F, 0.42F},
                                                       {0.55F, 0.36F, 0.24F},
                                                       {0.62F, 0.61F, 0.57F},
                                                       {0.45F, 0.50F, 0.52F},
                                                       {0.58F, 0.45F, 0.30F},
                                                       {0.40F, 0.24F, 0.20F},
                                                       {0.50F, 0.53F, 0.42F}}};
  const auto brightness = static_cast<float>(random->uniform(0.7, 1.0));
  return brightness * kColors[random->integer(static_cast<int>(kColors.size()))];
}

Material wall_material(Random* random) {
  Material material;
  material.seed = random->bits32();
  material.color = wall_color(random);
  switch (random->integer(3)) {
    case 0:
      material.kind = MaterialKind::kBrick;
      material.color =
          Eigen::Vector3f(0.36F, 0.16F, 0.11F) * static_cast<float>(random->uniform(0.7, 1.3));
      material.accent = Eigen::Vector3f::Constant(0.45F);
      material.size = {0.30F, 0.10F};
      break;
    case 1:
      material.kind = MaterialKind::kPanels;
      material.accent = 0.55F * material.color;
      material.size = {1.2F, 0.6F};
      break;
    default:
      material.kind = MaterialKind::kPlaster;
      material.accent = 0.6F * material.color;
  }
  return material;
}

Surface building_surface(SceneBuilder* builder, const Material& material) {
  return {street_class::kBuilding, builder->add_material(material)};
}

Material plain(MaterialKind kind, const Eigen::Vector3f& color, Random* random) {
  Material material;
  material.kind = kind;
  material.color = color;
  material.accent = 0.6F * color;
  material.seed = random->bits32();
  return material;
}

}  // namespace

BuildingStyle draw_building_style(SceneBuilder* builder, double width, Random* random) {
  BuildingStyle style;
  style.floor_height = random->uniform(2.9, 3.4);
  style.sill_height = random->uniform(0.8, 1.0);
  style.window_width = random->uniform(1.0, 1.5);
  style.window_height = random->uniform(1.3, 1.6);
  style.floors = 2 + random->integer(2);
  style.bays = std::max(2, static_cast<int>(width / random->uniform(2.5, 3.2)));
  style.door_bay = random->integer(style.bays);
  style.pitched = random->chance(0.6);
  style.ledge = random->chance(0.6);
  style.wall = building_surface(builder, wall_material(random));
  Material window = plain(MaterialKind::kWindow, {0.05F, 0.06F, 0.07F}, random);
  window.accent = random->chance(0.7) ? Eigen::Vector3f(0.75F, 0.74F, 0.70F)
                                      : Eigen::Vector3f(0.20F, 0.14F, 0.09F);
  window.size = Eigen::Vector2d(style.window_width, style.window_height).cast<float>();
  style.window = building_surface(builder, window);
  Material door = plain(MaterialKind::kDoor, {0.25F, 0.13F, 0.07F}, random);
  door.size =
      Eigen::Vector2d(style.window_width, style.sill_height + style.window_height).cast<float>();
  style.door = building_surface(builder, door);
  style.trim = building_surface(
      builder, plain(MaterialKind::kTrim, Eigen::Vector3f(0.55F, 0.53F, 0.48F), random));
  Material roof = plain(MaterialKind::kRoofTiles, {0.36F, 0.14F, 0.09F}, random);
  roof.size = {0.25F, 0.32F};
  style.roof = building_surface(builder, roof);
  return style;
}

}  // namespace facet_mapping
