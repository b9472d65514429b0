// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Solid noise and band-limited patterns: the atoms of every texture.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace facet_mapping {

/// Pseudo-random value in [0, 1) of a lattice cell.
float cell_hash(std::int32_t x, std::int32_t y, std::uint32_t seed);

/// Gradient noise (Perlin 2002): zero mean, about [-1, 1], features of about one unit.
float gradient_noise(const Eigen::Vector3f& point, std::uint32_t seed);

/// Octaves `first_frequency * 2^k` (per metre) of equal amplitude, so that some texture is left at
/// every distance. Octaves finer than `footprint` (metres a sample covers) fade out.
float octave_noise(const Eigen::Vector3f& point,
                   float first_frequency,
                   int octaves,
                   float footprint,
                   std::uint32_t seed);

/// 1 for features much larger than the footprint, 0 for features below it.
float visible_share(float feature_size, float footprint);

/// Share of [x - footprint / 2, x + footprint / 2] that lies in [k * period, k * period + width).
float stripe_coverage(float x, float period, float width, float footprint);

/// Share of the same interval that lies in [low, high].
float interval_coverage(float x, float low, float high, float footprint);

inline Eigen::Vector3f blend(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float share_of_b) {
  return a + share_of_b * (b - a);
}

}  // namespace facet_mapping
