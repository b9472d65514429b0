// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "scene_parts.h"

namespace facet_mapping {
namespace {

constexpr double kPoleRadius = 0.1;
constexpr double kPi = 3.14159265358979323846;

void add_post(const Scene& scene, double height) {
  const Surface surface{street_class::kPole, scene.shared.metal};
  std::vector<TubeRing> rings;
  const int count = static_cast<int>(std::ceil(height));
  for (int k = 0; k <= count; ++k) {
    rings.push_back({{0.0, 0.0, -0.15 + (height + 0.15) * k / count}, kPoleRadius});
  }
  add_tube(scene.builder, rings, 20, surface);
  std::vector<SceneVertex> cap;
  for (int k = 0; k < 20; ++k) {
    const double angle = 2.0 * kPi * k / 20;
    const Eigen::Vector3d p(kPoleRadius * std::cos(angle), kPoleRadius * std::sin(angle), height);
    cap.push_back({p, p.cast<float>()});
  }
  scene.builder->add_fan(cap, surface);
}

/// Outline of a sign in its own plane (right, up), counter-clockwise seen from its front.
std::vector<Eigen::Vector2d> sign_outline(int shape, double half_extent) {
  const int corners = shape == 0 ? 28 : (shape == 1 ? 3 : 4);
  const double start = shape == 2 ? 0.25 * kPi : 0.5 * kPi;
  const double radius = half_extent * (shape == 2 ? std::sqrt(2.0) : (shape == 1 ? 1.2 : 1.0));
  std::vector<Eigen::Vector2d> outline;
  for (int k = 0; k < corners; ++k) {
    const double angle = start + 2.0 * kPi * k / corners;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

/// A plate in front of the pole that faces -x: front, back and rim.
void add_sign_plate(const Scene& scene,
                    const std::vector<Eigen::Vector2d>& outline,
                    double height,
                    const Surface& front,
                    const Surface& back) {
  constexpr double kFrontX = -kPoleRadius - 0.05;
  constexpr double kBackX = -kPoleRadius - 0.02;
  const auto vertex = [&](std::size_t k, double x) {
    const Eigen::Vector2d& p = outline[k % outline.size()];
    return SceneVertex{{x, -p.x(), height + p.y()},
                       {static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F}};
  };
  std::vector<SceneVertex> front_ring;
  std::vector<SceneVertex> back_ring;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    front_ring.push_back(vertex(k, kFrontX));
    back_ring.push_back(vertex(outline.size() - k, kBackX));
    scene.builder->add_quad(
        {vertex(k, kFrontX), vertex(k, kBackX), vertex(k + 1, kBackX), vertex(k + 1, kFrontX)},
        back);
  }
  scene.builder->add_fan(front_ring, front);
  scene.builder->add_fan(back_ring, back);
}

}  // namespace

void add_sign_pole(const Scene& scene, const Eigen::Isometry3d& map_from_local, Random* random) {
  const int shape = random->integer(3);
  const double half_extent = random->uniform(0.30, 0.42);
  const double height = random->uniform(2.2, 2.6);
  Material face;
  face.kind = MaterialKind::kSign;
  face.color =
      shape == 2 ? Eigen::Vector3f(0.02F, 0.10F, 0.45F) : Eigen::Vector3f(0.75F, 0.75F, 0.72F);
  face.accent =
      shape == 2 ? Eigen::Vector3f(0.75F, 0.75F, 0.75F) : Eigen::Vector3f(0.55F, 0.02F, 0.02F);
  face.size = Eigen::Vector2f::Constant(static_cast<float>(half_extent));
  face.seed = 3U * (random->bits32() / 8U) + static_cast<std::uint32_t>(shape);
  const Surface front{street_class::kTrafficSign, scene.builder->add_material(face)};
  const Surface back{street_class::kTrafficSign, scene.shared.metal};
  scene.builder->begin_part(map_from_local);
  add_post(scene, height + half_extent + 0.1);
  add_sign_plate(scene, sign_outline(shape, half_extent), height, front, back);
}

void add_lamp_pole(const Scene& scene, const Eigen::Isometry3d& map_from_local) {
  constexpr double kHeight = 6.0;
  const Surface surface{street_class::kPole, scene.shared.metal};
  scene.builder->begin_part(map_from_local);
  add_post(scene, kHeight);
  scene.builder->add_box({-0.04, 0.0, kHeight - 0.12}, {0.04, 1.3, kHeight - 0.04}, surface);
  scene.builder->add_box({-0.13, 0.9, kHeight - 0.20}, {0.13, 1.6, kHeight - 0.121}, surface);
}

}  // namespace facet_mapping
