// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/surface.h"

#include <algorithm>
#include <array>

namespace facet_mapping::carving {
namespace {

using Corners = std::array<VertexHandle, 3>;

/// True if points stand close together at the corners: something was seen there.
bool is_observed(const Corners& corners, double max_edge_m) {
  for (int k = 0; k < 3; ++k) {
    const double edge = CGAL::squared_distance(corners[k]->point(), corners[(k + 1) % 3]->point());
    if (corners[k]->info().rays == 0 || edge > max_edge_m * max_edge_m) {
      return false;
    }
  }
  return true;
}

LabelEvidence facet_evidence(CellHandle matter, const Corners& corners) {
  if (matter->info().labels.best() != kUnlabelled) {
    return matter->info().labels;
  }
  LabelEvidence evidence;
  for (const VertexHandle corner : corners) {
    evidence.add(corner->info().labels);
  }
  return evidence;
}

/// Rays that end at the corners: at least one each.
std::uint16_t count_rays(const Corners& corners) {
  constexpr std::uint32_t kMost = 65535;
  std::uint32_t rays = 0;
  for (const VertexHandle corner : corners) {
    rays += corner->info().rays;
  }
  return static_cast<std::uint16_t>(std::min(rays, kMost));
}

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(double max_edge_m) : max_edge_m_(max_edge_m) {}

  void add_facet(CellHandle free, int facet) {
    // CGAL: the facet (i+1, i+2, i+3) of an odd i runs clockwise seen from outside the cell, which
    // is counter-clockwise seen from inside, from free space.
    Corners corners{free->vertex((facet + 1) & 3),
                    free->vertex((facet + 2) & 3),
                    free->vertex((facet + 3) & 3)};
    if (facet % 2 == 0) {
      std::swap(corners[0], corners[1]);
    }
    surface_.mesh.triangles.push_back({index(corners[0]), index(corners[1]), index(corners[2])});
    const bool observed = is_observed(corners, max_edge_m_);
    const LabelEvidence evidence =
        observed ? facet_evidence(free->neighbor(facet), corners) : LabelEvidence{};
    surface_.mesh.views.push_back(observed ? count_rays(corners) : 0);
    surface_.mesh.labels.push_back(evidence.best());
    surface_.mesh.confidence.push_back(evidence.margin());
  }

  CarvedSurface take() { return std::move(surface_); }

 private:
  std::uint32_t index(VertexHandle vertex) {
    VertexInfo& info = vertex->info();
    const bool is_known = info.mesh_index < surface_.vertex_ids.size() &&
                          surface_.vertex_ids[info.mesh_index] == info.id;
    if (!is_known) {
      info.mesh_index = static_cast<std::uint32_t>(surface_.mesh.vertices.size());
      const Point& p = vertex->point();
      surface_.mesh.vertices.emplace_back(p.x(), p.y(), p.z());
      surface_.vertex_ids.push_back(info.id);
    }
    return info.mesh_index;
  }

  double max_edge_m_;
  CarvedSurface surface_;
};

}  // namespace

CarvedSurface make_surface(const Triangulation& triangulation, double max_edge_m) {
  SurfaceBuilder builder(max_edge_m);
  for (const CellHandle cell : triangulation.finite_cell_handles()) {
    if (!cell->info().in_free_set) {
      continue;
    }
    for (int k = 0; k < 4; ++k) {
      if (!cell->neighbor(k)->info().in_free_set) {
        builder.add_facet(cell, k);
      }
    }
  }
  return builder.take();
}

}  // namespace facet_mapping::carving

namespace facet_mapping {

std::size_t CarvedSurface::bytes() const {
  return bytes_of(mesh) + bytes_of(vertex_ids);
}

}  // namespace facet_mapping
