// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise.h"

#include <algorithm>
#include <cmath>

namespace facet_mapping {
namespace {

std::uint32_t lattice_hash(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) {
  std::uint32_t h = x * 0x8DA6B343U ^ y * 0xD8163841U ^ z * 0xCB1AB31FU ^ seed * 0x9E3779B1U;
  h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12U)) * 0x297A2D39U;
  return h ^ (h >> 15U);
}

/// Dot product with one of the twelve edge directions of a cube, drawn by the hash.
float corner(std::uint32_t hash, float x, float y, float z) {
  const std::uint32_t h = hash >> 28U;
  const float u = h < 8 ? x : y;
  const float v = h < 4 ? y : (h == 12 || h == 14 ? x : z);
  return ((h & 1U) != 0U ? -u : u) + ((h & 2U) != 0U ? -v : v);
}

float fade(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

float mix(float a, float b, float t) { return a + t * (b - a); }

/// Length of [0, x] covered by the stripes, the integral of the stripe pattern.
float stripe_integral(float x, float period, float width) {
  const float k = std::floor(x / period);
  return k * width + std::min(x - k * period, width);
}

}  // namespace

float cell_hash(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  const std::uint32_t h =
      lattice_hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0x68BC21EBU, seed);
  return static_cast<float>(h >> 8U) * 0x1.0p-24F;
}

float gradient_noise(const Eigen::Vector3f& point, std::uint32_t seed) {
  const float floor_x = std::floor(point.x());
  const float floor_y = std::floor(point.y());
  const float floor_z = std::floor(point.z());
  const float x = point.x() - floor_x;
  const float y = point.y() - floor_y;
  const float z = point.z() - floor_z;
  const auto ix = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor_x));
  const auto iy = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor_y));
  const auto iz = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor_z));
  const auto at = [&](std::uint32_t dx, std::uint32_t dy, std::uint32_t dz) {
    return corner(lattice_hash(ix + dx, iy + dy, iz + dz, seed),
                  x - static_cast<float>(dx),
                  y - static_cast<float>(dy),
                  z - static_cast<float>(dz));
  };
  const float u = fade(x);
  const float v = fade(y);
  const float near_z = mix(mix(at(0, 0, 0), at(1, 0, 0), u), mix(at(0, 1, 0), at(1, 1, 0), u), v);
  const float far_z = mix(mix(at(0, 0, 1), at(1, 0, 1), u), mix(at(0, 1, 1), at(1, 1, 1), u), v);
  return mix(near_z, far_z, fade(z));
}

float octave_noise(const Eigen::Vector3f& point,
                   float first_frequency,
                   int octaves,
                   float footprint,
                   std::uint32_t seed) {
  float sum = 0.0F;
  float frequency = first_frequency;
  for (int k = 0; k < octaves; ++k, frequency *= 2.0F) {
    const float share = visible_share(0.5F / frequency, footprint);
    if (share <= 0.0F) {
      break;
    }
    // An offset per octave, since gradient noise is zero at every lattice point.
    const float shift = 0.37F * static_cast<float>(k);
    sum += share * gradient_noise(frequency * point + Eigen::Vector3f::Constant(shift),
                                  seed + static_cast<std::uint32_t>(k));
  }
  return sum;
}

float visible_share(float feature_size, float footprint) {
  return std::clamp(2.0F * feature_size / footprint - 1.0F, 0.0F, 1.0F);
}

float stripe_coverage(float x, float period, float width, float footprint) {
  const float local = x - std::floor(x / period) * period;  // keeps the difference exact
  const float low = stripe_integral(local - 0.5F * footprint, period, width);
  const float high = stripe_integral(local + 0.5F * footprint, period, width);
  return (high - low) / footprint;
}

float interval_coverage(float x, float low, float high, float footprint) {
  const float begin = std::max(low, x - 0.5F * footprint);
  const float end = std::min(high, x + 0.5F * footprint);
  return std::clamp((end - begin) / footprint, 0.0F, 1.0F);
}

}  // namespace facet_mapping
