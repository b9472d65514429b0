// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "noise.h"
#include "scene_car.h"
#include "texture.h"

namespace facet_mapping::texture {
namespace {

using namespace standard_car;

/// Share of a point within `radius` of the origin of the first two coordinates.
float disc(float x, float y, float radius, float footprint) {
  return std::clamp((radius - std::hypot(x, y)) / footprint + 0.5F, 0.0F, 1.0F);
}

/// Share on the inner side of the line through a and b (to its left), by distance.
float beside(const Eigen::Vector2f& p,
             const Eigen::Vector2f& a,
             const Eigen::Vector2f& b,
             float footprint) {
  const Eigen::Vector2f along = (b - a).normalized();
  const float distance = along.x() * (p.y() - a.y()) - along.y() * (p.x() - a.x());
  return std::clamp(distance / footprint + 0.5F, 0.0F, 1.0F);
}

/// Side windows between the belt, the roof and the two sloping pillars.
float side_glass(const Eigen::Vector3f& p, float footprint) {
  const Eigen::Vector2f q(p.x(), p.z());
  const float height = interval_coverage(p.z(), kBelt + 0.03F, 1.36F, footprint);
  const float front = beside(q, {0.86F, kBelt}, {0.22F, 1.40F}, footprint);
  const float rear = beside(q, {-1.40F, 1.40F}, {-1.72F, kBelt}, footprint);
  const float pillar = interval_coverage(p.x(), -0.52F, -0.42F, footprint);
  return height * front * rear * (1.0F - pillar);
}

/// Windscreen and rear window, on the upper side of the body.
float end_glass(const Eigen::Vector3f& p, float footprint) {
  const float across = interval_coverage(std::abs(p.y()), -1.0F, 0.60F, footprint);
  const float ends = interval_coverage(p.x(), 0.40F, 0.98F, footprint) +
                     interval_coverage(p.x(), -1.92F, -1.62F, footprint);
  return across * ends;
}

float glass_share(const Eigen::Vector3f& p, float footprint) {
  if (p.z() < kBelt) {
    return 0.0F;
  }
  const bool on_top = p.z() > top_height(p.x()) - 0.05F * (1.0F + 2.0F * std::abs(p.y()));
  return on_top && std::abs(p.y()) < 0.66F ? end_glass(p, footprint) : side_glass(p, footprint);
}

/// Gaps around the doors, the bonnet and the tailgate.
float gap_share(const Eigen::Vector3f& p, float footprint) {
  constexpr float kHalfGap = 0.008F;
  float gap = 0.0F;
  if (std::abs(p.y()) > 0.6F && p.z() > 0.35F && p.z() < 1.36F) {
    for (const float x : {0.62F, -0.47F, -1.22F}) {
      gap += interval_coverage(p.x(), x - kHalfGap, x + kHalfGap, footprint);
    }
    gap += 0.7F * interval_coverage(p.z(), 0.70F, 0.71F, footprint);  // a moulding
  }
  if (p.z() > 0.6F && p.z() < kBelt + 0.1F && p.x() > 0.9F) {
    gap += interval_coverage(std::abs(p.y()), 0.66F, 0.68F, footprint);
  }
  return std::min(1.0F, gap);
}

float arch_share(const Eigen::Vector3f& p, float footprint) {
  if (std::abs(p.y()) < 0.6F) {
    return 0.0F;
  }
  return disc(p.x() - kFrontAxle, p.z() - kWheelRadius, 0.375F, footprint) +
         disc(p.x() - kRearAxle, p.z() - kWheelRadius, 0.375F, footprint);
}

struct Patch {
  Eigen::Vector3f color;
  float share;
};

/// Lamps and number plates at both ends.
std::array<Patch, 3> fittings(const Eigen::Vector3f& p, float footprint) {
  const bool front = p.x() > 0.0F;
  const float end = interval_coverage(std::abs(p.x()), 1.86F, 3.0F, footprint);
  const float lamp_height = front ? interval_coverage(p.z(), 0.60F, 0.75F, footprint)
                                  : interval_coverage(p.z(), 0.70F, 0.90F, footprint);
  const float inner = front ? 0.50F : 0.62F;
  const float lamp =
      end * lamp_height * interval_coverage(std::abs(p.y()), inner, 0.84F, footprint);
  const float plate = end * interval_coverage(p.z(), 0.42F, 0.53F, footprint) *
                      interval_coverage(p.y(), -0.26F, 0.26F, footprint);
  const float text = plate * stripe_coverage(p.y() + 0.26F, 0.075F, 0.04F, footprint) *
                     interval_coverage(p.z(), 0.445F, 0.505F, footprint) *
                     interval_coverage(p.y(), -0.2F, 0.22F, footprint);
  const Eigen::Vector3f glow =
      front ? Eigen::Vector3f(0.6F, 0.62F, 0.65F) : Eigen::Vector3f(0.42F, 0.02F, 0.02F);
  return {Patch{glow, lamp},
          {Eigen::Vector3f(0.7F, 0.7F, 0.66F), plate},
          {Eigen::Vector3f(0.03F, 0.03F, 0.05F), text}};
}

}  // namespace

Eigen::Vector3f car_body(const Material& m, const Eigen::Vector3f& p, float footprint) {
  // Paint has next to no texture: broad reflections and a little dust, more of it below.
  const float broad = octave_noise(p, 0.8F, 2, footprint, m.seed);
  const float dust = octave_noise(p, 6.0F, 4, footprint, m.seed + 3U);
  const float low = std::clamp((0.55F - p.z()) / 0.35F, 0.0F, 1.0F);
  Eigen::Vector3f color = shaded(m.color, 0.06F * broad + (0.03F + 0.10F * low) * dust);
  color = blend(color, Eigen::Vector3f(0.16F, 0.14F, 0.11F), 0.35F * low);
  const float sky = std::clamp((p.z() - kBelt) / 0.5F, 0.0F, 1.0F);
  const Eigen::Vector3f glass = shaded(
      Eigen::Vector3f(0.035F, 0.04F, 0.045F) + 0.07F * sky * Eigen::Vector3f(0.8F, 0.9F, 1.0F),
      0.5F * octave_noise(p, 1.3F, 3, footprint, m.seed + 5U));
  color = blend(color, glass, std::min(1.0F, glass_share(p, footprint)));
  const Eigen::Vector3f black = Eigen::Vector3f::Constant(0.02F);
  color = blend(color, black, 0.8F * gap_share(p, footprint));
  for (const Patch& patch : fittings(p, footprint)) {
    color = blend(color, patch.color, patch.share);
  }
  return blend(color, black, std::min(1.0F, arch_share(p, footprint)));
}

Eigen::Vector3f wheel(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const float rim = p.z() > -0.01F ? disc(p.x(), p.y(), 0.20F, footprint) : 0.0F;
  const float angle = std::atan2(p.y(), p.x());
  const float radius = std::hypot(p.x(), p.y());
  const float arc = radius * angle;
  const float period = radius * 6.2831853F / 5.0F;
  const float hole = radius > 0.05F && radius < 0.17F
                         ? stripe_coverage(arc + 4.0F, period, 0.55F * period, footprint)
                         : 0.0F;
  const float dirt = octave_noise(p, 4.0F, 4, footprint, m.seed);
  const Eigen::Vector3f tyre = shaded(m.color, 0.3F * dirt);
  return blend(tyre, shaded(m.accent, 0.1F * dirt), rim * (1.0F - 0.85F * hole));
}

Eigen::Vector3f sign(const Material& m, const Eigen::Vector3f& p, float footprint) {
  const float r = m.size.x();
  const std::uint32_t shape = m.seed % 3U;
  float rim = 0.0F;
  float figure = 0.0F;
  if (shape == 0U) {  // a red ring and a dark number
    rim = 1.0F - disc(p.x(), p.y(), 0.78F * r, footprint);
    figure = interval_coverage(p.y(), -0.4F * r, 0.4F * r, footprint) *
             stripe_coverage(p.x() + 0.45F * r, 0.5F * r, 0.28F * r, footprint) *
             interval_coverage(p.x(), -0.45F * r, 0.5F * r, footprint);
  } else if (shape == 1U) {  // a triangle: distance to the nearest side
    const float inner = 0.6F * r;
    const float side = std::max(-p.y(), 0.5F * p.y() + 0.866F * std::abs(p.x()));
    rim = std::clamp((side - inner + 0.17F * r) / footprint + 0.5F, 0.0F, 1.0F);
    figure = interval_coverage(p.x(), -0.06F * r, 0.06F * r, footprint) *
             interval_coverage(p.y(), -0.25F * r, 0.4F * r, footprint);
  } else {  // a white bar and border on blue
    const float away = std::max(std::abs(p.x()), std::abs(p.y()));
    rim = interval_coverage(away, 0.85F * r, 0.93F * r, footprint);
    figure = interval_coverage(std::abs(p.x() + 0.2F * r), -1.0F, 0.13F * r, footprint) *
                 interval_coverage(p.y(), -0.6F * r, 0.6F * r, footprint) +
             interval_coverage(p.x(), -0.2F * r, 0.35F * r, footprint) *
                 (interval_coverage(p.y(), 0.4F * r, 0.6F * r, footprint) +
                  interval_coverage(p.y(), -0.1F * r, 0.1F * r, footprint));
  }
  const Eigen::Vector3f ink =
      shape == 2U ? m.accent : Eigen::Vector3f(Eigen::Vector3f::Constant(0.03F));
  const Eigen::Vector3f plate = blend(m.color, ink, std::clamp(figure, 0.0F, 1.0F));
  return blend(plate, m.accent, std::clamp(rim, 0.0F, 1.0F)) *
         (1.0F + 0.05F * octave_noise(p, 2.0F, 4, footprint, m.seed));
}

}  // namespace facet_mapping::texture
