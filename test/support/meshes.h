// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small meshes and views that the tests of several rooms build on. Facets are counter-clockwise
// seen from outside (from above for planes); lengths in metres.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping::test {

/// Grid of cells_x * cells_y squares (two facets each) centred at the origin, z = height(x, y).
template <typename Height>
TriangleMesh make_height_field(int cells_x, int cells_y, double cell_m, const Height& height) {
  TriangleMesh mesh;
  for (int j = 0; j <= cells_y; ++j) {
    for (int i = 0; i <= cells_x; ++i) {
      const double x = (i - 0.5 * cells_x) * cell_m;
      const double y = (j - 0.5 * cells_y) * cell_m;
      mesh.vertices.emplace_back(x, y, height(x, y));
    }
  }
  const auto vertex = [cells_x](int i, int j) {
    return static_cast<std::uint32_t>(j * (cells_x + 1) + i);
  };
  for (int j = 0; j < cells_y; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

/// Flat grid in the plane z = 0, normal up.
inline TriangleMesh make_grid_plane(int cells_x, int cells_y, double cell_m) {
  return make_height_field(cells_x, cells_y, cell_m, [](double, double) { return 0.0; });
}

/// Closed latitude-longitude sphere at the origin (two poles, rings - 1 circles of vertices).
inline TriangleMesh make_uv_sphere(double radius_m, int rings, int segments) {
  constexpr double kPi = 3.14159265358979323846;
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0.0, 0.0, radius_m);
  for (int r = 1; r < rings; ++r) {
    const double theta = kPi * r / rings;
    for (int s = 0; s < segments; ++s) {
      const double phi = 2.0 * kPi * s / segments;
      mesh.vertices.emplace_back(radius_m * std::sin(theta) * std::cos(phi),
                                 radius_m * std::sin(theta) * std::sin(phi),
                                 radius_m * std::cos(theta));
    }
  }
  mesh.vertices.emplace_back(0.0, 0.0, -radius_m);
  const auto south = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto vertex = [segments](int r, int s) {
    return static_cast<std::uint32_t>(1 + (r - 1) * segments + s % segments);
  };
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0, vertex(1, s), vertex(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({vertex(r, s), vertex(r + 1, s), vertex(r + 1, s + 1)});
      mesh.triangles.push_back({vertex(r, s), vertex(r + 1, s + 1), vertex(r, s + 1)});
    }
    mesh.triangles.push_back({vertex(rings - 1, s), south, vertex(rings - 1, s + 1)});
  }
  return mesh;
}

/// Splits every facet into four at its edge midpoints; attributes are dropped.
inline TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh fine;
  fine.vertices = mesh.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto added = middles.try_emplace(std::minmax(a, b), fine.vertices.size());
    if (added.second) {
      fine.vertices.emplace_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    }
    return added.first->second;
  };
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]);
    const std::uint32_t bc = middle(t[1], t[2]);
    const std::uint32_t ca = middle(t[2], t[0]);
    fine.triangles.insert(fine.triangles.end(),
                          {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }
  return fine;
}

/// Closed sphere at the origin from a subdivided octahedron: 8 * 4^subdivisions facets.
inline TriangleMesh make_sphere(double radius_m, int subdivisions) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {
      {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < subdivisions; ++k) {
    mesh = subdivided(mesh);
    for (Eigen::Vector3d& v : mesh.vertices) {
      v.normalize();
    }
  }
  for (Eigen::Vector3d& v : mesh.vertices) {
    v *= radius_m;
  }
  return mesh;
}

/// Closed box at the origin; every face is a grid of 2 * 4^subdivisions facets. The faces follow
/// each other in the order -x, +x, -y, +y, -z, +z, so that facet / (facets / 6) is the face.
inline TriangleMesh make_box(const Eigen::Vector3d& half_size_m, int subdivisions) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    mesh.vertices.emplace_back(half_size_m.cwiseProduct(sign));
  }
  mesh.triangles = {{0, 4, 6},
                    {0, 6, 2},
                    {1, 3, 7},
                    {1, 7, 5},
                    {0, 1, 5},
                    {0, 5, 4},
                    {2, 6, 7},
                    {2, 7, 3},
                    {0, 2, 3},
                    {0, 3, 1},
                    {4, 5, 7},
                    {4, 7, 6}};
  for (int k = 0; k < subdivisions; ++k) {
    mesh = subdivided(mesh);
  }
  return mesh;
}

/// The same surface seen from the other side.
inline TriangleMesh flipped(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) {
    std::swap(t[1], t[2]);
  }
  return mesh;
}

inline TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& motion) {
  for (Eigen::Vector3d& v : mesh.vertices) {
    v = motion * v;
  }
  return mesh;
}

/// Both meshes in one; attributes are dropped.
inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  a.labels.clear();
  a.confidence.clear();
  a.views.clear();
  return a;
}

/// Camera with its principal point in the middle of the image.
inline PinholeCamera make_camera(int width, int height, double focal_px) {
  return {width, height, focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1)};
}

/// View from `eye` towards `target`, image upright with respect to +z (+y if looking along z).
inline View look_at(const PinholeCamera& camera,
                    const Eigen::Vector3d& eye,
                    const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const bool vertical = std::abs(forward.z()) > 0.999;
  const Eigen::Vector3d up = vertical ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  View view;
  view.camera = camera;
  view.world_from_cam.linear().col(0) = right;
  view.world_from_cam.linear().col(1) = forward.cross(right);
  view.world_from_cam.linear().col(2) = forward;
  view.world_from_cam.translation() = eye;
  return view;
}

}  // namespace facet_mapping::test
