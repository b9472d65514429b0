// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kStepX = 0x8DA6B343U;
constexpr std::uint32_t kStepY = 0xD8163841U;
constexpr std::uint32_t kStepZ = 0xCB1AB31FU;

/// Scrambles the sum of a cell's coordinates times the steps above.
std::uint32_t scramble(std::uint32_t h) {
  h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12U)) * 0x297A2D39U;
  return h ^ (h >> 15U);
}

/// std::floor without a call into the library, for |x| < 2^31.
std::int32_t floor_to_int(float x) {
  const auto truncated = static_cast<std::int32_t>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

struct Gradient {
  float x, y, z;
};

/// The middles of a cube's edges, four of them twice.
constexpr std::array<Gradient, 16> kGradients{{{1, 1, 0},
                                               {-1, 1, 0},
                                               {1, -1, 0},
                                               {-1, -1, 0},
                                               {1, 0, 1},
                                               {-1, 0, 1},
                                               {1, 0, -1},
                                               {-1, 0, -1},
                                               {0, 1, 1},
                                               {0, -1, 1},
                                               {0, 1, -1},
                                               {0, -1, -1},
                                               {1, 1, 0},
                                               {-1, 1, 0},
                                               {0, -1, 1},
                                               {0, -1, -1}}};

/// Dot product with the gradient that the hash draws; a table, as branches on it mispredict.
float corner(std::uint32_t hash, float x, float y, float z) {
  const Gradient& g = kGradients[hash >> 28U];
  return g.x * x + g.y * y + g.z * z;
}

float fade(float t) {
  return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

float mix(float a, float b, float t) {
  return a + t * (b - a);
}

/// Length of [0, x] covered by the stripes, the integral of the stripe pattern.
float stripe_integral(float x, float period, float width) {
  const float k = std::floor(x / period);
  return k * width + std::min(x - k * period, width);
}

}  // namespace

float cell_hash(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  const std::uint32_t h = scramble(static_cast<std::uint32_t>(x) * kStepX +
                                   static_cast<std::uint32_t>(y) * kStepY + scramble(seed));
  return static_cast<float>(h >> 8U) * 0x1.0p-24F;
}

float gradient_noise(const Eigen::Vector3f& point, std::uint32_t seed) {
  const std::int32_t ix = floor_to_int(point.x());
  const std::int32_t iy = floor_to_int(point.y());
  const std::int32_t iz = floor_to_int(point.z());
  const float x = point.x() - static_cast<float>(ix);
  const float y = point.y() - static_cast<float>(iy);
  const float z = point.z() - static_cast<float>(iz);
  const std::uint32_t base = static_cast<std::uint32_t>(ix) * kStepX +
                             static_cast<std::uint32_t>(iy) * kStepY +
                             static_cast<std::uint32_t>(iz) * kStepZ + seed * 0x9E3779B1U;
  const auto row = [&](std::uint32_t offset, float dy, float dz, float u) {
    return mix(corner(scramble(base + offset), x, dy, dz),
               corner(scramble(base + offset + kStepX), x - 1.0F, dy, dz),
               u);
  };
  const float u = fade(x);
  const float v = fade(y);
  const float low = mix(row(0U, y, z, u), row(kStepY, y - 1.0F, z, u), v);
  const float high =
      mix(row(kStepZ, y, z - 1.0F, u), row(kStepY + kStepZ, y - 1.0F, z - 1.0F, u), v);
  return mix(low, high, fade(z));
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
