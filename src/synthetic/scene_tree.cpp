// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "foliage.h"
#include "noise.h"
#include "scene_parts.h"

namespace facet_mapping {
namespace {

constexpr double kTwoPi = 6.283185307179586;

struct Sphere {
  std::vector<Eigen::Vector3d> directions;
  std::vector<Triangle> triangles;
};

Sphere octahedron() {
  Sphere sphere;
  sphere.directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  sphere.triangles = {
      {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return sphere;
}

/// Every triangle cut in four.
Sphere subdivided(const Sphere& coarse) {
  Sphere fine;
  fine.directions = coarse.directions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto index = static_cast<std::uint32_t>(fine.directions.size());
    const auto [entry, added] = middles.emplace(std::minmax(a, b), index);
    if (added) {
      fine.directions.push_back((fine.directions[a] + fine.directions[b]).normalized());
    }
    return entry->second;
  };
  for (const Triangle& t : coarse.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]);
    const std::uint32_t bc = middle(t[1], t[2]);
    const std::uint32_t ca = middle(t[2], t[0]);
    fine.triangles.insert(fine.triangles.end(),
                          {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }
  return fine;
}

const Sphere& unit_sphere() {
  static const Sphere kSphere = [] {
    Sphere sphere = octahedron();
    for (int level = 0; level < 5; ++level) {
      sphere = subdivided(sphere);
    }
    return sphere;
  }();
  return kSphere;
}

struct Ball {
  Eigen::Vector3d center;
  double radius;
};

/// A crown is the union of balls around the origin, roughened by noise.
struct Crown {
  std::vector<Ball> balls;
  std::uint32_t seed;

  double radius(const Eigen::Vector3d& direction) const {
    double farthest = 0.0;
    for (const Ball& ball : balls) {
      const double along = direction.dot(ball.center);
      const double root = along * along - ball.center.squaredNorm() + ball.radius * ball.radius;
      if (root > 0.0) {
        farthest = std::max(farthest, along + std::sqrt(root));
      }
    }
    const Eigen::Vector3f p = (farthest * direction).cast<float>();
    return farthest * (1.0 + 0.13 * octave_noise(p, 1.0F, 3, 0.01F, seed));
  }
};

Crown draw_crown(double radius, Random* random) {
  Crown crown;
  crown.seed = random->bits32();
  crown.balls.push_back({Eigen::Vector3d::Zero(), 0.75 * radius});
  for (int k = 0; k < 9; ++k) {
    const double angle = kTwoPi * random->uniform();
    const double up = random->uniform(-0.5, 0.9);
    const double flat = std::sqrt(1.0 - up * up);
    const Eigen::Vector3d direction(flat * std::cos(angle), flat * std::sin(angle), up);
    crown.balls.push_back({0.55 * radius * direction, random->uniform(0.35, 0.5) * radius});
  }
  return crown;
}

void add_trunk(const Scene& scene, double height, const Eigen::Vector2d& lean, Random* random) {
  const double foot = random->uniform(0.15, 0.22);
  std::vector<TubeRing> rings;
  constexpr int kRings = 8;
  for (int k = 0; k <= kRings; ++k) {
    const double share = static_cast<double>(k) / kRings;
    const double flare = k == 0 ? 0.05 : 0.0;
    rings.push_back(
        {Eigen::Vector3d(
             lean.x() * share * share, lean.y() * share * share, -0.15 + share * (height + 0.15)),
         foot * (1.0 - 0.45 * share) + flare});
  }
  add_tube(scene.builder, rings, 12, {street_class::kVegetation, scene.shared.bark});
}

}  // namespace

void add_tree(const Scene& scene, const Eigen::Isometry3d& map_from_local, Random* random) {
  const double radius = random->uniform(1.3, 2.1);
  const double crown_height = 2.2 + radius;
  const double lean_x = random->uniform(-0.2, 0.2);
  const Eigen::Vector2d lean(lean_x, random->uniform(-0.2, 0.2));
  const Eigen::Vector3f color = leaf_color(random);
  const Surface leaves{street_class::kVegetation,
                       scene.builder->add_material(foliage(color, random->bits32()))};
  scene.builder->begin_part(map_from_local);
  add_trunk(scene, crown_height, lean, random);
  const Crown crown = draw_crown(radius, random);
  const Eigen::Vector3d center(lean.x(), lean.y(), crown_height);
  const Sphere& sphere = unit_sphere();
  std::uint32_t first = 0;
  for (std::size_t v = 0; v < sphere.directions.size(); ++v) {
    const Eigen::Vector3d offset = crown.radius(sphere.directions[v]) * sphere.directions[v];
    const std::uint32_t index = scene.builder->add_vertex({center + offset, offset.cast<float>()});
    first = v == 0 ? index : first;
  }
  for (const Triangle& t : sphere.triangles) {
    scene.builder->add_triangle(first + t[0], first + t[1], first + t[2], leaves);
  }
}

}  // namespace facet_mapping
