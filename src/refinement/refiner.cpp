// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/refiner.h"

#include "check_input.h"
#include "refinement_run.h"

namespace facet_mapping {

RefinementResult refine(const TriangleMesh& mesh,
                        const std::vector<LabeledView>& views,
                        const LabelSet& labels,
                        const RefinementConfig& config,
                        const ProgressCallback& progress) {
  check_config(config);
  check_views(views);
  validate(mesh);
  check_mesh(mesh);
  RefinementConfig own_config = config;
  const std::vector<Label> sky = labels.sky_ids();
  own_config.labeling.excluded.insert(own_config.labeling.excluded.end(), sky.begin(), sky.end());
  return RefinementRun(mesh, views, labels, own_config, progress).run();
}

}  // namespace facet_mapping
