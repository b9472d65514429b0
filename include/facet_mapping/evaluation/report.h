// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluations of one or several meshes as a table for people and as JSON for programs.
#pragma once

#include <string>
#include <vector>

#include "facet_mapping/evaluation/mesh_evaluation.h"

namespace facet_mapping {

struct NamedEvaluation {
  std::string name;  ///< heads the column
  MeshEvaluation evaluation;
};

/// One column per mesh, and with two or more a last one with the change from the first to the last.
/// Lengths are in millimetres if the first mesh's mean error is below 0.1 m, else in metres.
/// `depth` are the options that all evaluations were made with.
std::string evaluation_table(const std::vector<NamedEvaluation>& meshes,
                             const DepthErrorOptions& depth,
                             const LabelSet& labels);

/// Everything in SI units, shares 0..1, with the scores of each view; unknown values are null.
std::string evaluation_json(const std::vector<NamedEvaluation>& meshes,
                            const DepthErrorOptions& depth,
                            const LabelSet& labels);

}  // namespace facet_mapping
