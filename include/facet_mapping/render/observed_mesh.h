// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a mesh that images can be compared with: without the facets that only close it.
#pragma once

#include <cstdint>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

class ObservedMesh {
 public:
  explicit ObservedMesh(const TriangleMesh& whole);

  /// The facets that are no gaps (see is_gap), in the order of the whole mesh.
  const TriangleMesh& mesh() const { return mesh_; }
  /// For each facet of mesh() its index in the whole mesh.
  const std::vector<std::uint32_t>& whole_facets() const { return whole_facets_; }

  /// mesh() rendered, with the facet ids of the whole mesh.
  FacetImage render(FacetRenderer* renderer, const View& view) const;

 private:
  TriangleMesh mesh_;
  std::vector<std::uint32_t> whole_facets_;
};

}  // namespace facet_mapping
