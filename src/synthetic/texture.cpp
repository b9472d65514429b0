// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture.h"

#include <algorithm>

#include "noise.h"

namespace facet_mapping {
namespace texture {

Eigen::Vector3f shaded(const Eigen::Vector3f& color, float change) {
  return color * std::max(0.1F, 1.0F + change);
}

Eigen::Vector3f worn(const Material& m, const Eigen::Vector3f& p, float footprint, float strength) {
  return shaded(m.color, strength * octave_noise(p, 0.7F, 7, footprint, m.seed));
}

Eigen::Vector3f bark(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const Eigen::Vector3f stretched(p.x(), p.y(), 0.25F * p.z());
  const float ridge = octave_noise(stretched, 6.0F, 5, footprint, m.seed);
  return blend(m.color, m.accent, std::clamp(0.5F + 0.8F * ridge, 0.0F, 1.0F));
}

Eigen::Vector3f foliage(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const float clumps = octave_noise(p, 0.6F, 2, footprint, m.seed);
  const float leaves = octave_noise(p, 2.5F, 5, footprint, m.seed + 31U);
  const float dark = std::clamp(0.42F - 0.35F * clumps - 0.70F * leaves, 0.0F, 1.0F);
  return blend(m.color, m.accent, dark);
}

}  // namespace texture

Eigen::Vector3f reflectance(const Material& material,
                            const Eigen::Vector3f& point,
                            float footprint) {
  using Function = Eigen::Vector3f (*)(const Material&, const Eigen::Vector3f&, float);
  constexpr auto kPlain = +[](const Material& m, const Eigen::Vector3f& p, float footprint_m) {
    return texture::worn(m, p, footprint_m, 0.10F);
  };
  // In the order of MaterialKind.
  constexpr Function kTextures[] = {texture::asphalt,
                                    texture::kerb,
                                    texture::paving,
                                    texture::grass,
                                    texture::brick,
                                    texture::plaster,
                                    texture::panels,
                                    texture::window,
                                    texture::door,
                                    kPlain,
                                    texture::roof_tiles,
                                    texture::car_body,
                                    texture::wheel,
                                    kPlain,
                                    texture::sign,
                                    texture::bark,
                                    texture::foliage};
  return kTextures[static_cast<std::size_t>(material.kind)](material, point, footprint);
}

}  // namespace facet_mapping
