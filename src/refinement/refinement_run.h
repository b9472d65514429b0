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
  /// In the place of run().
  RefinementEstimate estimate();

 private:
  /// Labels the mesh if it has none, and chooses the pairs of views.
  void begin();
  /// Labels the mesh anew from the views' segmentations; keeps labels where there are none.
  void relabel(TriangleMesh* mesh);
  bool has_segmentation() const;

  /// What is compared to tell the better of two shapes, on the finest level's images.
  struct Measured {
    EnergyTerms terms;
    PhotometricEnergy photometric;
    double labels = 0.0;  ///< energy of the segmentations per photometric pixel of the start
  };
  /// `pixels`: photometric pixels of the start; 0: this is the start.
  Measured measure(const TriangleMesh& mesh, std::size_t pixels) const;
  /// By how much the energy per pixel rises.
  double change(const Measured& from, const Measured& to) const;

  /// Takes the mesh, and its energies for the result, unless its energy is above the start's.
  bool take_if_better(const Measured& before, TriangleMesh mesh, TriangleMesh* best);

  /// Refine `current_` at one level; false if the run was cancelled.
  bool refine_level(int level);
  bool iterate(int level, LevelProblem* problem);
  /// Splits what is too large at this level, and labels the pieces.
  void split_facets(const LevelProblem& problem);
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
