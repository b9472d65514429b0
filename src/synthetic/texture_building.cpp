// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "noise.h"
#include "texture.h"

namespace facet_mapping::texture {
namespace {

/// Dirt of every size, and streaks that run down the wall.
float weather(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const Eigen::Vector3f streak(2.0F * p.x(), 0.2F * p.y(), p.z());
  return 0.11F * octave_noise(p, 0.3F, 8, footprint, m.seed) +
         0.10F * octave_noise(streak, 0.8F, 3, footprint, m.seed + 41U);
}

struct Masonry {
  float stone;  ///< pseudo-random in [-0.5, 0.5), 0 where stones are too small to see
  float joint;  ///< share of the joint
};

Masonry masonry(const Material& m, const Eigen::Vector3f& p, float joint, float footprint) {
  const float row = std::floor(p.y() / m.size.y());
  const float shifted = p.x() + 0.5F * m.size.x() * (row - 2.0F * std::floor(0.5F * row));
  const auto column = static_cast<std::int32_t>(std::floor(shifted / m.size.x()));
  const float hash = cell_hash(column, static_cast<std::int32_t>(row), m.seed) - 0.5F;
  const float lines = stripe_coverage(shifted, m.size.x(), joint, footprint) +
                      stripe_coverage(p.y(), m.size.y(), joint, footprint);
  return {hash * visible_share(0.7F * m.size.y(), footprint), std::min(1.0F, lines)};
}

/// Share of the point inside the frame of a pane with `bars` upright divisions.
float frame_share(const Material& m, const Eigen::Vector3f& p, int bars, float footprint) {
  constexpr float kFrame = 0.07F;
  float glass = interval_coverage(p.x(), kFrame, m.size.x() - kFrame, footprint) *
                interval_coverage(p.y(), kFrame, m.size.y() - kFrame, footprint);
  for (int k = 1; k <= bars; ++k) {
    const float x = m.size.x() * static_cast<float>(k) / static_cast<float>(bars + 1);
    glass *= 1.0F - interval_coverage(p.x(), x - 0.03F, x + 0.03F, footprint);
  }
  const float cross = 0.68F * m.size.y();
  glass *= 1.0F - interval_coverage(p.y(), cross - 0.025F, cross + 0.025F, footprint);
  return 1.0F - glass;
}

}  // namespace

Eigen::Vector3f brick(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const Masonry bricks = masonry(m, p, 0.014F, footprint);
  const Eigen::Vector3f stone = shaded(m.color, 0.7F * bricks.stone);
  return shaded(blend(stone, m.accent, bricks.joint), weather(m, p, footprint));
}

Eigen::Vector3f plaster(const Material& m, const Eigen::Vector3f& p, float footprint) {
  // The foot of the wall is painted darker and dirtier.
  const float foot = interval_coverage(p.y(), -1.0F, 0.55F, footprint);
  const Eigen::Vector3f paint = blend(m.color, m.accent, 0.8F * foot);
  return shaded(paint, weather(m, p, footprint));
}

Eigen::Vector3f panels(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const Masonry slabs = masonry(m, p, 0.025F, footprint);
  const Eigen::Vector3f stone = shaded(m.color, 0.22F * slabs.stone);
  return shaded(blend(stone, m.accent, slabs.joint), weather(m, p, footprint));
}

Eigen::Vector3f window(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const auto number = static_cast<std::int32_t>(p.z());
  const float kind = cell_hash(number, 1, m.seed);
  // The room behind: dark below, brighter above where the sky mirrors, with soft shapes.
  const Eigen::Vector3f inside(p.x(), p.y(), 3.7F * static_cast<float>(number));
  const float shapes = octave_noise(inside, 0.9F, 3, footprint, m.seed + 7U);
  const float sky = std::clamp(p.y() / m.size.y(), 0.0F, 1.0F);
  Eigen::Vector3f glass =
      shaded(m.color + 0.10F * sky * Eigen::Vector3f(0.7F, 0.85F, 1.0F), 0.6F * shapes);
  if (kind < 0.55F) {  // curtains cover a part of the pane
    const float open = 0.12F + 0.3F * cell_hash(number, 2, m.seed);
    const float away = std::abs(p.x() / m.size.x() - 0.5F);
    const float curtain = std::clamp((away - open) * m.size.x() / footprint + 0.5F, 0.0F, 1.0F);
    const float folds = octave_noise(
        {6.0F * p.x(), 0.3F * p.y(), inside.z()}, 1.0F, 3, 6.0F * footprint, m.seed + 9U);
    glass = blend(glass, shaded(Eigen::Vector3f(0.50F, 0.47F, 0.42F), 0.35F * folds), curtain);
  } else if (kind < 0.75F) {  // a blind, let down
    const float low = m.size.y() * (0.2F + 0.6F * cell_hash(number, 3, m.seed));
    const float blind = interval_coverage(p.y(), low, m.size.y(), footprint);
    const float slat = stripe_coverage(p.y(), 0.08F, 0.03F, footprint);
    glass = blend(glass, shaded(Eigen::Vector3f(0.42F, 0.41F, 0.38F), -0.4F * slat), blind);
  }
  const Eigen::Vector3f frame =
      shaded(m.accent, 0.08F * octave_noise(inside, 2.0F, 5, footprint, m.seed));
  return blend(glass, frame, frame_share(m, p, m.size.x() > 1.2F ? 1 : 0, footprint));
}

Eigen::Vector3f door(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const Eigen::Vector3f grain_point(4.0F * p.x(), 0.4F * p.y(), p.z());
  const float grain = octave_noise(grain_point, 1.5F, 5, 3.0F * footprint, m.seed);
  const float frame = frame_share(m, p, 1, footprint);
  return shaded(blend(m.color, m.accent, 0.7F * frame), 0.22F * grain);
}

Eigen::Vector3f roof_tiles(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const Masonry tiles = masonry(m, p, 0.035F, footprint);
  const Eigen::Vector3f tile = shaded(m.color, 0.5F * tiles.stone);
  return shaded(blend(tile, m.accent, tiles.joint), weather(m, p, footprint));
}

}  // namespace facet_mapping::texture
