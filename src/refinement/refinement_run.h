// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One call of refine(): the loop over pyramid levels and iterations.
#pragma once

#include <vector>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/refinement/level_problem.h"
#include "facet_mapping/refinement/refiner.h"

namespace facet_mapping {

class RefinementRun {
 public:
  /// The arguments are those of refine(), already checked; all must outlive the run.
  RefinementRun(const TriangleMesh& mesh,
                const std::vector<LabeledView>& views,
                const LabelSet& labels,
                const RefinementConfig& config,
                const ProgressCallback& progress);

  RefinementResult run();

 private:
  /// Labels the mesh anew from the views' segmentations; keeps labels where there are none.
  void relabel(TriangleMesh* mesh);
  bool has_segmentation() const;

  /// Iterates at one level; false if the run was cancelled.
  bool refine_level(int level);
  bool report(int level, int iteration, const EnergyTerms& energy);

  const TriangleMesh& start_;
  const std::vector<LabeledView>& views_;
  const LabelSet& labels_;
  const RefinementConfig& config_;
  const ProgressCallback& progress_;
  LevelProblem finest_;
  TriangleMesh current_;
  RefinementResult result_;
};

}  // namespace facet_mapping
