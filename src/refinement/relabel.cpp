// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_run.h"

#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

void RefinementRun::relabel(TriangleMesh* mesh) {
  std::vector<FacetImage> renderings;
  for (SurfaceView& surface : finest_.render(*mesh)) {
    renderings.push_back(std::move(surface.image));
  }
  const LabelingResult labeling = label_facets(*mesh, views_, renderings, config_.labeling);
  if (!mesh->labels.empty()) {
    result_.relabelled += labeling.changed;
  }
  apply_labeling(labeling, mesh);
}

}  // namespace facet_mapping
