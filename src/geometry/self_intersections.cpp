// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/self_intersections.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vector>

#ifdef __clang_analyzer__
#define CGAL_DO_NOT_USE_MPZF  // the analyser takes how it keeps its digits for an error
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace facet_mapping {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using FacetPair = std::pair<Surface::Face_index, Surface::Face_index>;

/// The mesh as CGAL wants it. A facet that would make it non-manifold gets corners of its own.
struct Converted {
  Surface surface;
  std::vector<std::size_t> facets;  ///< of the mesh, per face
  std::vector<bool> loose;          ///< per face: it has corners of its own
};

void add_facet(const TriangleMesh& mesh, std::size_t facet, Converted* to) {
  const Triangle& t = mesh.triangles[facet];
  std::array<Surface::Vertex_index, 3> corners;
  for (int k = 0; k < 3; ++k) {
    corners[k] = Surface::Vertex_index(t[k]);
  }
  const bool fits = to->surface.add_face(corners[0], corners[1], corners[2]).is_valid();
  if (!fits) {
    for (Surface::Vertex_index& corner : corners) {
      const Kernel::Point_3 point = to->surface.point(corner);
      corner = to->surface.add_vertex(point);
    }
    to->surface.add_face(corners[0], corners[1], corners[2]);
  }
  to->facets.push_back(facet);
  to->loose.push_back(!fits);
}

Converted convert(const TriangleMesh& mesh) {
  Converted converted;
  const std::size_t facets = mesh.triangles.size();
  converted.surface.reserve(mesh.vertices.size(), 2 * facets, facets);
  for (const Eigen::Vector3d& v : mesh.vertices) {
    converted.surface.add_vertex({v.x(), v.y(), v.z()});
  }
  for (std::size_t f = 0; f < facets; ++f) {
    const Triangle& t = mesh.triangles[f];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
      add_facet(mesh, f, &converted);
    }
  }
  return converted;
}

bool share_a_vertex(const Triangle& a, const Triangle& b) {
  return std::any_of(
      a.begin(), a.end(), [&b](std::uint32_t v) { return v == b[0] || v == b[1] || v == b[2]; });
}

}  // namespace

std::size_t count_self_intersections(const TriangleMesh& mesh) {
  validate(mesh);
  const Converted converted = convert(mesh);
  std::vector<FacetPair> pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(
      converted.surface, std::back_inserter(pairs));
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [&](const FacetPair& pair) {
        const auto [a, b] = pair;
        const bool by_mesh = !converted.loose[a] && !converted.loose[b];
        return a != b && (by_mesh || !share_a_vertex(mesh.triangles[converted.facets[a]],
                                                     mesh.triangles[converted.facets[b]]));
      }));
}

}  // namespace facet_mapping
