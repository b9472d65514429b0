// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_parts.h"

namespace facet_mapping {

SharedMaterials add_shared_materials(SceneBuilder* builder, Random* random) {
  const auto add = [&](MaterialKind kind,
                       const Eigen::Vector3f& color,
                       const Eigen::Vector3f& accent,
                       const Eigen::Vector2f& size) {
    return builder->add_material({kind, color, accent, size, random->bits32()});
  };
  const Eigen::Vector2f one = Eigen::Vector2f::Ones();
  const Eigen::Vector3f paint(0.62F, 0.62F, 0.58F);
  const Eigen::Vector3f stone(0.36F, 0.35F, 0.33F);
  const Eigen::Vector3f slab(0.34F, 0.32F, 0.29F);
  const Eigen::Vector3f lawn(0.17F, 0.20F, 0.07F);
  const Eigen::Vector3f soil(0.22F, 0.18F, 0.10F);
  SharedMaterials shared;
  shared.asphalt = add(MaterialKind::kAsphalt,
                       {0.17F, 0.17F, 0.175F},
                       paint,
                       {static_cast<float>(cross_section::kRoadHalfWidth), 3.0F});
  shared.kerb = add(MaterialKind::kKerb, stone, 0.5F * stone, {1.0F, 1.0F});
  shared.paving = add(MaterialKind::kPaving, slab, 0.4F * slab, {0.5F, 0.5F});
  shared.grass = add(MaterialKind::kGrass, lawn, soil, one);
  shared.bark = add(MaterialKind::kBark, {0.17F, 0.13F, 0.09F}, {0.05F, 0.04F, 0.03F}, one);
  shared.metal = add(MaterialKind::kMetal, {0.33F, 0.34F, 0.35F}, {0.2F, 0.2F, 0.2F}, one);
  shared.wheel = add(MaterialKind::kWheel, {0.03F, 0.03F, 0.03F}, {0.40F, 0.41F, 0.42F}, one);
  shared.backdrop = add(MaterialKind::kFoliage, {0.15F, 0.20F, 0.06F}, {0.03F, 0.05F, 0.015F}, one);
  return shared;
}

}  // namespace facet_mapping
