// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "foliage.h"
#include "noise.h"
#include "scene_parts.h"

namespace facet_mapping {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A standing sheet of leaves along a line of the ground plan, bumpy and of uneven height. Its
/// outside is to the right of the way from `from` to `to`, given in street coordinates (s, t).
void add_leaf_wall(const Scene& scene,
                   const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to,
                   std::uint32_t seed) {
  constexpr double kStep = 0.6;
  constexpr int kUp = 12;
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d away(-along.y(), along.x());
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kStep)));
  const auto vertex = [&](int row, int column) {
    const Eigen::Vector2d foot = from + (to - from) * row / steps;
    const Eigen::Vector3f crest(
        0.12F * static_cast<float>(foot.x()), 0.12F * static_cast<float>(foot.y()), 7.5F);
    const double height = 5.0 + 1.6 * octave_noise(crest, 1.0F, 3, 0.01F, seed);
    const double h = -0.3 + height * column / kUp;
    const Eigen::Vector3f p = Eigen::Vector3d(foot.x(), foot.y(), h).cast<float>();
    const double bump = 0.9 * octave_noise(p, 0.45F, 3, 0.01F, seed + 17U);
    const Eigen::Vector2d place = foot + (0.12 * h + bump) * away;
    return SceneVertex{scene.line->to_map(place.x(), place.y(), h),
                       Eigen::Vector3d(place.x(), place.y(), h).cast<float>()};
  };
  scene.builder->begin_part();
  scene.builder->add_grid(steps, kUp, vertex, {street_class::kVegetation, scene.shared.backdrop});
}

}  // namespace

void add_hedge(const Scene& scene,
               const Eigen::Isometry3d& map_from_local,
               double length,
               Random* random) {
  constexpr int kAround = 16;
  const double width = random->uniform(0.55, 0.8);
  const double height = random->uniform(0.8, 1.4);
  const std::uint32_t seed = random->bits32();
  const Surface leaves{street_class::kVegetation,
                       scene.builder->add_material(foliage(leaf_color(random), seed))};
  const int rows = std::max(4, static_cast<int>(length / 0.14));
  const auto vertex = [&](int row, int column) {
    const double x = length * row / rows;
    const double end = std::min({1.0, x / 0.25, (length - x) / 0.25});
    const double scale = 0.6 + 0.4 * std::sqrt(std::max(0.0, end * (2.0 - end)));
    const double angle = kPi * column / kAround;  // right foot, over the top, left foot
    const double c = -std::cos(angle);
    const double s = std::sin(angle);
    // A superellipse: a box with round edges.
    Eigen::Vector3d p(x,
                      0.5 * width * scale * std::copysign(std::sqrt(std::abs(c)), c),
                      -0.1 + (height * scale + 0.1) * std::sqrt(std::max(0.0, s)));
    const double bump = 0.05 * octave_noise(p.cast<float>(), 2.5F, 3, 0.01F, seed);
    p += bump * Eigen::Vector3d(0.0, c, s);
    return SceneVertex{p, p.cast<float>()};
  };
  scene.builder->begin_part(map_from_local);
  scene.builder->add_grid(rows, kAround, vertex, leaves);
  for (const int row : {0, rows}) {
    std::vector<SceneVertex> ring;
    for (int k = 0; k <= kAround; ++k) {
      ring.push_back(vertex(row, row == 0 ? k : kAround - k));
    }
    scene.builder->add_fan(ring, leaves);
  }
}

void add_backdrop(const Scene& scene, std::uint32_t seed) {
  constexpr double kPart = 24.0;
  const double far = cross_section::kBackdrop;
  const double begin = scene.line->begin();
  const double end = scene.line->end() + 15.0;
  const int parts = std::max(1, static_cast<int>(std::ceil((end - begin) / kPart)));
  const auto s = [&](int part) { return begin + (end - begin) * part / parts; };
  for (int part = 0; part < parts; ++part) {
    add_leaf_wall(scene, {s(part), far}, {s(part + 1), far}, seed);
    add_leaf_wall(scene, {s(part + 1), -far}, {s(part), -far}, seed);
  }
  add_leaf_wall(scene, {end, far + 1.0}, {end, -far - 1.0}, seed);
}

}  // namespace facet_mapping
