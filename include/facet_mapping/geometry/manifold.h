// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An independent check of the facets alone: is the mesh a closed, oriented 2-manifold?
#pragma once

#include <cstddef>
#include <string>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

struct ManifoldReport {
  std::size_t degenerate_facets = 0;      ///< facets that name a vertex twice
  std::size_t open_edges = 0;             ///< edges with one facet
  std::size_t non_manifold_edges = 0;     ///< edges with more than two facets
  std::size_t misoriented_edges = 0;      ///< edges whose two facets run through it the same way
  std::size_t non_manifold_vertices = 0;  ///< vertices whose facets form more than one fan

  bool is_closed_manifold() const;
  std::string to_string() const;
};

ManifoldReport check_manifold(const TriangleMesh& mesh);

}  // namespace facet_mapping
