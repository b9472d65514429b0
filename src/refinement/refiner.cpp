// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/refiner.h"

#include <algorithm>
#include <memory>

#include "check_input.h"
#include "refinement_run.h"

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

namespace {

std::vector<LabeledView> views_of_part(const TriangleMesh& mesh,
                                       const std::vector<LabeledView>& views,
                                       const MeshPart& part) {
  const std::vector<std::uint8_t> inside = facets_of_part(mesh, part);
  const std::unique_ptr<FacetRenderer> renderer = make_renderer();
  std::vector<LabeledView> seeing;
  for (const LabeledView& view : views) {
    const FacetImage image = renderer->render(mesh, view.view);
    const bool sees = std::any_of(image.facets.begin<int>(), image.facets.end<int>(), [&](int f) {
      return f >= 0 && inside[f] != 0;
    });
    if (sees) {
      seeing.push_back(view);
    }
  }
  return seeing;
}

}  // namespace

RefinementResult refine(const TriangleMesh& mesh,
                        const std::vector<LabeledView>& views,
                        const LabelSet& labels,
                        const RefinementConfig& config,
                        const ProgressCallback& progress) {
  check_config(config);
  check_views(views);
  validate(mesh);
  check_mesh(mesh, config.part);
  RefinementConfig own_config = config;
  const std::vector<Label> sky = labels.sky_ids();
  own_config.labeling.excluded.insert(own_config.labeling.excluded.end(), sky.begin(), sky.end());
  if (config.part.is_everything()) {
    return RefinementRun(mesh, views, labels, own_config, progress).run();
  }
  const std::vector<LabeledView> seeing = views_of_part(mesh, views, config.part);
  check_part_views(seeing.size(), views.size());
  return RefinementRun(mesh, seeing, labels, own_config, progress).run();
}

}  // namespace facet_mapping
