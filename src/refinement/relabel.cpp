// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_run.h"

#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {
namespace {

void keep_outside(const TriangleMesh& mesh, const MeshPart& part, LabelingResult* labeling) {
  const std::vector<std::uint8_t> inside = facets_of_part(mesh, part);
  for (std::size_t f = 0; f < inside.size(); ++f) {
    if (inside[f] == 0) {
      labeling->changed -= labeling->labels[f] != mesh.labels[f] ? 1 : 0;
      labeling->labels[f] = mesh.labels[f];
      labeling->confidence[f] = mesh.confidence.empty() ? 0.0F : mesh.confidence[f];
    }
  }
}

}  // namespace

void RefinementRun::relabel(TriangleMesh* mesh) {
  std::vector<FacetImage> renderings;
  for (SurfaceView& surface : finest_.render(*mesh)) {
    renderings.push_back(std::move(surface.image));
  }
  LabelingResult labeling = label_facets(*mesh, views_, renderings, config_.labeling);
  if (!mesh->labels.empty()) {
    keep_outside(*mesh, config_.part, &labeling);
    result_.relabelled += labeling.changed;
  }
  apply_labeling(labeling, mesh);
}

}  // namespace facet_mapping
