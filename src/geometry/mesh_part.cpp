// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/mesh_part.h"

#include <set>

#include "facet_mapping/geometry/facet_centroid.h"

namespace facet_mapping {

std::vector<std::uint8_t> facets_of_part(const TriangleMesh& mesh, const MeshPart& part) {
  const std::set<Label> wanted(part.classes.begin(), part.classes.end());
  std::vector<std::uint8_t> facets(mesh.triangles.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Label label = mesh.labels.empty() ? kUnlabelled : mesh.labels[f];
    const Eigen::Vector3d centroid = facet_centroid(mesh.vertices, mesh.triangles[f]);
    const bool inside = part.box.isEmpty() || part.box.contains(part.box_from_mesh * centroid);
    facets[f] = inside && (wanted.empty() || wanted.count(label) > 0) ? 1 : 0;
  }
  return facets;
}

std::vector<std::uint8_t> vertices_inside(const TriangleMesh& mesh,
                                          const std::vector<std::uint8_t>& facets) {
  std::vector<std::uint8_t> vertices(mesh.vertices.size(), 1);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      vertices[v] &= facets[f];
    }
  }
  return vertices;
}

}  // namespace facet_mapping
