// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "noise.h"
#include "texture.h"

namespace facet_mapping::texture {
namespace {

/// Thin dark lines where a slowly varying noise crosses zero: cracks and tar seams.
float crack(
    const Eigen::Vector3f& p, float frequency, float width, float footprint, std::uint32_t seed) {
  const float field = octave_noise(frequency * p, 1.0F, 2, frequency * footprint, seed);
  const float distance = std::abs(field) / (1.5F * frequency);  // metres, roughly
  const float blur = std::max(width, footprint);
  return std::clamp(1.0F - distance / blur, 0.0F, 1.0F) * width / blur;
}

/// Share of the point that is painted: a dashed middle line and lines at the parking places.
float marking(const Material& m, const Eigen::Vector3f& p, float footprint) {
  constexpr float kWidth = 0.14F;
  const float middle = interval_coverage(p.y(), -0.5F * kWidth, 0.5F * kWidth, footprint) *
                       stripe_coverage(p.x(), 3.0F * m.size.y(), m.size.y(), footprint);
  const float side = m.size.x() - 2.15F;
  const float edge = interval_coverage(std::abs(p.y()), side - 0.05F, side + 0.05F, footprint) *
                     stripe_coverage(p.x(), 1.5F, 0.75F, footprint);
  if (middle + edge <= 0.0F) {
    return 0.0F;
  }
  const float wear = 0.85F + 0.35F * octave_noise(p, 3.0F, 4, footprint, m.seed + 5U);
  return std::clamp((middle + edge) * wear, 0.0F, 1.0F);
}

}  // namespace

Eigen::Vector3f asphalt(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const float blotches = octave_noise(p, 0.25F, 3, footprint, m.seed);
  const float grain = octave_noise(p, 2.0F, 6, footprint, m.seed + 11U);
  // Long repairs along the street have a shade of their own.
  const Eigen::Vector3f repair_point(0.05F * p.x(), 0.45F * p.y(), 0.0F);
  const float repair = gradient_noise(repair_point, m.seed + 23U) > 0.25F ? -0.16F : 0.0F;
  const float cracks = crack(p, 0.35F, 0.025F, footprint, m.seed + 29U);
  const Eigen::Vector3f road =
      shaded(m.color, 0.10F * blotches + 0.17F * grain + repair - 0.6F * cracks);
  return blend(road, m.accent, marking(m, p, footprint));
}

Eigen::Vector3f kerb(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const float joint = stripe_coverage(p.x(), m.size.x(), 0.02F, footprint);
  const float wear = octave_noise(p, 1.0F, 7, footprint, m.seed);
  const auto stone = static_cast<std::int32_t>(std::floor(p.x() / m.size.x()));
  const float shade = 0.25F * (cell_hash(stone, p.z() < 0.0F ? 1 : 0, m.seed) - 0.5F);
  return blend(shaded(m.color, 0.14F * wear + shade), m.accent, joint);
}

Eigen::Vector3f paving(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const float row = std::floor(p.y() / m.size.y());
  const float shifted = p.x() + 0.5F * m.size.x() * (row - 2.0F * std::floor(0.5F * row));
  const auto column = static_cast<std::int32_t>(std::floor(shifted / m.size.x()));
  const float seen = visible_share(0.5F * m.size.x(), footprint);
  const float slab = cell_hash(column, static_cast<std::int32_t>(row), m.seed) - 0.5F;
  const float joint = std::min(1.0F,
                               stripe_coverage(shifted, m.size.x(), 0.015F, footprint) +
                                   stripe_coverage(p.y(), m.size.y(), 0.015F, footprint));
  const float wear = octave_noise(p, 0.4F, 8, footprint, m.seed);
  return blend(shaded(m.color, 0.45F * seen * slab + 0.13F * wear), m.accent, joint);
}

Eigen::Vector3f grass(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const float patches = octave_noise(p, 0.35F, 3, footprint, m.seed);
  const float blades = octave_noise(p, 3.0F, 6, footprint, m.seed + 3U);
  const float soil = std::clamp(0.25F + 0.8F * patches, 0.0F, 1.0F);
  return shaded(blend(m.color, m.accent, soil), 0.28F * blades);
}

}  // namespace facet_mapping::texture
