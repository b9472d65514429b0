// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_car.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene_parts.h"

namespace facet_mapping {
namespace standard_car {

float top_height(float x) {
  struct Knot {
    float x;
    float z;
  };
  static constexpr std::array<Knot, 12> kProfile{{{-2.10F, 0.52F},
                                                  {-2.06F, 0.84F},
                                                  {-1.97F, 0.97F},
                                                  {-1.58F, 1.36F},
                                                  {-1.30F, 1.43F},
                                                  {-0.60F, 1.47F},
                                                  {0.05F, 1.45F},
                                                  {0.36F, 1.38F},
                                                  {1.04F, 0.97F},
                                                  {1.80F, 0.82F},
                                                  {2.02F, 0.70F},
                                                  {2.10F, 0.52F}}};
  const float clamped = std::clamp(x, -kHalfLength, kHalfLength);
  std::size_t k = 0;
  while (k + 2 < kProfile.size() && kProfile[k + 1].x < clamped) {
    ++k;
  }
  const float share = (clamped - kProfile[k].x) / (kProfile[k + 1].x - kProfile[k].x);
  return kProfile[k].z + share * (kProfile[k + 1].z - kProfile[k].z);
}

float bottom_height(float x) {
  const float end = std::max(0.0F, std::abs(x) - 1.6F) / (kHalfLength - 1.6F);
  return 0.22F + 0.14F * end * end;
}

float half_width(float x) {
  const float u = std::abs(x) / kHalfLength;
  return kHalfWidth * (1.0F - 0.16F * std::pow(u, 6.0F) - 0.03F * u * u);
}

}  // namespace standard_car

namespace {

using namespace standard_car;

constexpr std::array<float, 26> kStations{-2.10F, -2.08F, -2.06F, -2.01F, -1.97F, -1.87F, -1.77F,
                                          -1.67F, -1.58F, -1.44F, -1.30F, -1.00F, -0.60F, -0.25F,
                                          0.05F,  0.20F,  0.36F,  0.55F,  0.80F,  1.04F,  1.30F,
                                          1.55F,  1.80F,  1.92F,  2.02F,  2.10F};
constexpr int kHalfRing = 10;  // points from the sill to the middle of the roof

/// Points of the left half of a cross-section from the sill up to the middle, (y, z).
std::array<Eigen::Vector2d, kHalfRing> half_section(float x) {
  const double w = half_width(x);
  const double top = top_height(x);
  const double bottom = bottom_height(x);
  const double belt = std::min<double>(kBelt, top - 0.06);
  const double middle = 0.5 * (bottom + belt);
  const double rise = top - belt;
  const double shoulder = 0.97 * w;
  const double edge = shoulder - 0.10 - 0.34 * std::max(0.0, rise - 0.10);  // roof edge
  return {Eigen::Vector2d(0.93 * w, bottom),
          {0.99 * w, 0.5 * (bottom + middle)},
          {w, middle},
          {0.995 * w, 0.4 * middle + 0.6 * belt},
          {shoulder, belt},
          {0.5 * (shoulder + edge) + 0.02, belt + 0.5 * rise},
          {edge + 0.015, belt + 0.86 * rise},
          {edge - 0.05, belt + 0.95 * rise},
          {0.5 * edge, belt + 0.99 * rise},
          {0.0, top}};
}

/// Ring point `k` of 2 * kHalfRing - 1, from the right sill over the roof to the left sill.
Eigen::Vector3d ring_point(float x, int k) {
  const auto section = half_section(x);
  const bool left = k >= kHalfRing;
  const Eigen::Vector2d& p = section[left ? 2 * kHalfRing - 2 - k : k];
  return {x, left ? p.x() : -p.x(), p.y()};
}

SceneVertex body_vertex(const Eigen::Vector3d& standard, const Eigen::Vector3d& stretch) {
  return {standard.cwiseProduct(stretch), standard.cast<float>()};
}

/// The flat piece that closes the body at its first or last station.
void add_body_end(SceneBuilder* builder, const Eigen::Vector3d& stretch, const Surface& surface) {
  for (const bool front : {false, true}) {
    const float x = front ? kHalfLength : -kHalfLength;
    std::vector<SceneVertex> ring;
    for (int k = 0; k < 2 * kHalfRing - 1; ++k) {
      const int index = front ? 2 * kHalfRing - 2 - k : k;
      ring.push_back(body_vertex(ring_point(x, index), stretch));
    }
    builder->add_fan(ring, surface);
  }
}

void add_body(SceneBuilder* builder, const Eigen::Vector3d& stretch, const Surface& surface) {
  const int rows = static_cast<int>(kStations.size()) - 1;
  const auto shell = [&](int row, int column) {
    return body_vertex(ring_point(kStations[row], column), stretch);
  };
  const auto underside = [&](int row, int column) {
    const int index = column == 0 ? 2 * kHalfRing - 2 : 0;
    return body_vertex(ring_point(kStations[row], index), stretch);
  };
  builder->add_grid(rows, 2 * kHalfRing - 2, shell, surface);
  builder->add_grid(rows, 1, underside, surface);
  add_body_end(builder, stretch, surface);
}

/// A wheel: tread and outer face, on the side `side` of the car.
void add_wheel(SceneBuilder* builder,
               const Eigen::Vector3d& hub,
               int side,
               const Surface& surface) {
  constexpr int kSides = 20;
  const double radius = hub.z();
  const auto point = [&](int k, double y) {
    const double angle = side * 6.283185307179586 * k / kSides;
    const Eigen::Vector3d offset(radius * std::sin(angle), side * y, radius * std::cos(angle));
    return SceneVertex{hub + offset, Eigen::Vector3d(offset.x(), offset.z(), y).cast<float>()};
  };
  const auto tread = [&](int row, int column) {
    return point(row, column == 0 ? -kWheelWidth : 0.0);
  };
  builder->add_grid(kSides, 1, tread, surface);
  std::vector<SceneVertex> ring;
  for (int k = 0; k < kSides; ++k) {
    ring.push_back(point(k, 0.0));
  }
  builder->add_fan(ring, surface);
}

Eigen::Vector3f paint_color(Random* random) {
  static const std::array<Eigen::Vector3f, 8> kColors{{{0.55F, 0.56F, 0.57F},
                                                       {0.05F, 0.05F, 0.055F},
                                                       {0.65F, 0.65F, 0.63F},
                                                       {0.30F, 0.03F, 0.03F},
                                                       {0.03F, 0.07F, 0.22F},
                                                       {0.20F, 0.21F, 0.22F},
                                                       {0.05F, 0.16F, 0.10F},
                                                       {0.42F, 0.36F, 0.25F}}};
  return kColors[random->integer(static_cast<int>(kColors.size()))];
}

}  // namespace

void add_car(const Scene& scene, const Eigen::Isometry3d& map_from_local, Random* random) {
  const double longer = random->uniform(0.92, 1.10);
  const double wider = random->uniform(0.97, 1.04);
  const Eigen::Vector3d stretch(longer, wider, random->uniform(0.95, 1.15));
  Material paint;
  paint.kind = MaterialKind::kCarBody;
  paint.color = paint_color(random);
  paint.seed = random->bits32();
  const Surface body{street_class::kCar, scene.builder->add_material(paint)};
  scene.builder->begin_part(map_from_local);
  add_body(scene.builder, stretch, body);
  for (const float axle : {kFrontAxle, kRearAxle}) {
    for (const int side : {1, -1}) {
      const Eigen::Vector3d hub(
          axle * stretch.x(), side * (kHalfWidth * stretch.y() + 0.005), kWheelRadius);
      add_wheel(scene.builder, hub, side, {street_class::kCar, scene.shared.wheel});
    }
  }
}

}  // namespace facet_mapping
