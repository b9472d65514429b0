// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// An energy that compares, pixel by pixel, each view with its partners.
#pragma once

#include <cstddef>
#include <vector>

#include "ordered_reduce.h"
#include "pixel_forces.h"
#include "pixel_scatter.h"
#include <Eigen/Core>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/surface_view.h"

namespace facet_mapping {

/// Sum, pixels and, if asked for, field of an energy over all pairs (i, j in partners[i]). The
/// views are compared in parallel and their sums added in ascending order, so that the result is
/// the same whatever the number of threads. `normals`: one per facet. `compare(i, j, &forces)` adds
/// pair (i, j) to the sums of view i; the forces in them only count if a gradient is asked for.
template <typename Energy, typename PreparedView, typename Compare>
Energy sum_over_pairs(const TriangleMesh& mesh,
                      const std::vector<Eigen::Vector3d>& normals,
                      const std::vector<PreparedView>& views,
                      const std::vector<SurfaceView>& surfaces,
                      const std::vector<std::vector<int>>& partners,
                      bool with_gradient,
                      const Compare& compare) {
  Energy total;
  if (with_gradient) {
    total.field = VertexField(mesh.vertices.size());
  }
  const auto compare_view = [&](std::size_t i) {
    PixelForces forces;
    for (const int j : partners[i]) {
      compare(i, static_cast<std::size_t>(j), &forces);
    }
    return forces;
  };
  ordered_reduce(views.size(), compare_view, [&](std::size_t i, const PixelForces& forces) {
    total.sum += forces.energy;
    total.pixels += forces.pixels;
    if (with_gradient && !forces.force.empty()) {
      scatter_to_vertices(mesh,
                          normals,
                          views[i].view,
                          surfaces[i].image,
                          forces.force,
                          forces.curvature,
                          &total.field);
    }
  });
  return total;
}

}  // namespace facet_mapping
