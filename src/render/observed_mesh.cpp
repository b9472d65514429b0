// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/render/observed_mesh.h"

namespace facet_mapping {

ObservedMesh::ObservedMesh(const TriangleMesh& whole) {
  std::vector<bool> keep(whole.triangles.size());
  for (std::uint32_t f = 0; f < keep.size(); ++f) {
    keep[f] = !is_gap(whole, f);
    if (keep[f]) {
      whole_facets_.push_back(f);
    }
  }
  mesh_ = whole_facets_.size() == keep.size() ? whole : select_facets(whole, keep);
}

FacetImage ObservedMesh::render(FacetRenderer* renderer, const View& view) const {
  FacetImage image = renderer->render(mesh_, view);
  for (int y = 0; y < image.facets.rows; ++y) {
    auto* row = image.facets.ptr<std::int32_t>(y);
    for (int x = 0; x < image.facets.cols; ++x) {
      row[x] = row[x] < 0 ? row[x] : static_cast<std::int32_t>(whole_facets_[row[x]]);
    }
  }
  return image;
}

}  // namespace facet_mapping
