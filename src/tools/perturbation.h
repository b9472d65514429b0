// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Seeded displacements of a start mesh, for the spread of what is made of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/labeled_view.h"

namespace facet_mapping {

/// Metres per pixel at a point in the view where it is largest; 0 if no view shows the point.
inline double finest_pixel(const std::vector<LabeledView>& views, const Eigen::Vector3d& point) {
  double finest = std::numeric_limits<double>::infinity();
  for (const LabeledView& one : views) {
    const PinholeCamera& camera = one.view.camera;
    const Eigen::Vector3d in_cam = one.view.cam_from_world() * point;
    if (in_cam.z() > 0.0 && camera.contains(camera.project(in_cam))) {
      finest = std::min(finest, in_cam.z() / camera.fx);
    }
  }
  return finest < std::numeric_limits<double>::infinity() ? finest : 0.0;
}

/// Displaces each vertex in all three directions by a standard deviation of `sigma_px` pixels of
/// the nearest view (occlusion is not looked at). Vertices outside all views stay. Same seed, same
/// mesh.
inline void perturb(const std::vector<LabeledView>& views,
                    double sigma_px,
                    std::uint64_t seed,
                    TriangleMesh* mesh) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal;
  for (Eigen::Vector3d& vertex : mesh->vertices) {
    const Eigen::Vector3d direction(normal(bits), normal(bits), normal(bits));
    vertex += sigma_px * finest_pixel(views, vertex) * direction;
  }
}

}  // namespace facet_mapping
