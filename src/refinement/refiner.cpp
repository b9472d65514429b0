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

/// Checks the arguments of refine() and calls `work` with what of them counts.
template <typename Work>
auto with_checked(const TriangleMesh& mesh,
                  const std::vector<LabeledView>& views,
                  const LabelSet& labels,
                  const RefinementConfig& config,
                  const Work& work) {
  check_config(config);
  check_views(views);
  validate(mesh);
  check_mesh(mesh, config.part);
  RefinementConfig own_config = config;
  const std::vector<Label> sky = labels.sky_ids();
  own_config.labeling.excluded.insert(own_config.labeling.excluded.end(), sky.begin(), sky.end());
  if (config.part.is_everything()) {
    return work(views, own_config);
  }
  const std::vector<LabeledView> seeing = views_of_part(mesh, views, config.part);
  check_part_views(seeing.size(), views.size());
  return work(seeing, own_config);
}

}  // namespace

RefinementResult refine(const TriangleMesh& mesh,
                        const std::vector<LabeledView>& views,
                        const LabelSet& labels,
                        const RefinementConfig& config,
                        const ProgressCallback& progress) {
  return with_checked(mesh, views, labels, config, [&](const auto& seeing, const auto& own_config) {
    return RefinementRun(mesh, seeing, labels, own_config, progress).run();
  });
}

RefinementEstimate estimate_refinement(const TriangleMesh& mesh,
                                       const std::vector<LabeledView>& views,
                                       const LabelSet& labels,
                                       const RefinementConfig& config) {
  return with_checked(mesh, views, labels, config, [&](const auto& seeing, const auto& own_config) {
    return RefinementRun(mesh, seeing, labels, own_config, {}).estimate();
  });
}

}  // namespace facet_mapping
