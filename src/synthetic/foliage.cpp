// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "foliage.h"

#include "noise.h"

namespace facet_mapping {

Material foliage(const Eigen::Vector3f& color, std::uint32_t seed) {
  Material material;
  material.kind = MaterialKind::kFoliage;
  material.color = color;
  material.accent = 0.25F * color;
  material.seed = seed;
  return material;
}

Eigen::Vector3f leaf_color(Random* random) {
  const Eigen::Vector3f green(0.16F, 0.25F, 0.06F);
  const Eigen::Vector3f olive(0.28F, 0.26F, 0.08F);
  const auto brightness = static_cast<float>(random->uniform(0.75, 1.1));
  return brightness * blend(green, olive, static_cast<float>(random->uniform()));
}

}  // namespace facet_mapping
