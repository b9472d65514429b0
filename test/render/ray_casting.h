// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The slow and obvious answer to what a pixel sees: every facet against the pixel's ray.
#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping::test {

struct RayHit {
  std::int32_t facet = -1;
  double z = 0.0;  ///< metres
};

/// Nearest facet, from either side, along the ray through `pixel` beyond the near depth.
inline RayHit cast_ray(const TriangleMesh& mesh, const View& view, const Eigen::Vector2d& pixel) {
  const Eigen::Isometry3d cam_from_world = view.cam_from_world();
  const Eigen::Vector3d ray = view.camera.ray(pixel);
  RayHit best;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Eigen::Vector3d a = cam_from_world * mesh.vertices[mesh.triangles[f][0]];
    const Eigen::Vector3d b = cam_from_world * mesh.vertices[mesh.triangles[f][1]];
    const Eigen::Vector3d c = cam_from_world * mesh.vertices[mesh.triangles[f][2]];
    const double side_a = ray.dot(b.cross(c));
    const double side_b = ray.dot(c.cross(a));
    const double side_c = ray.dot(a.cross(b));
    const bool inside = (side_a >= 0.0 && side_b >= 0.0 && side_c >= 0.0) ||
                        (side_a <= 0.0 && side_b <= 0.0 && side_c <= 0.0);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double z = normal.dot(a) / normal.dot(ray);
    if (inside && z >= kNearDepth && (best.facet < 0 || z < best.z)) {
      best = {static_cast<std::int32_t>(f), z};
    }
  }
  return best;
}

/// Unconnected random facets in a cube around the origin, many of them around or behind a camera
/// that stands inside.
inline TriangleMesh make_soup(int facets, double half_size_m, double facet_size_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto any = [&] { return Eigen::Vector3d(unit(random), unit(random), unit(random)); };
  TriangleMesh mesh;
  for (int f = 0; f < facets; ++f) {
    const Eigen::Vector3d middle = half_size_m * any();
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) {
      mesh.vertices.emplace_back(middle + facet_size_m * any());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace facet_mapping::test
