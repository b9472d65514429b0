// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Qualities of one or several sources of points as a table for people and as JSON for programs.
#pragma once

#include <string>
#include <vector>

#include "facet_mapping/evaluation/point_quality.h"

namespace facet_mapping {

struct NamedPointScores {
  std::string name;    ///< of the source, heads the column
  std::string depths;  ///< what depths are compared with
  std::string labels;  ///< what classes are compared with
  PointScores scores;
  std::size_t images = 0;          ///< frames of the dataset that were given to the source
  double processor_seconds = 0.0;  ///< for making all points, without reading files
};

/// One column per source. `options` are those that all scores were made with.
std::string point_table(const std::vector<NamedPointScores>& sources,
                        const PointQualityOptions& options);

/// Everything in SI units, shares 0..1; unknown values are null.
std::string point_json(const std::vector<NamedPointScores>& sources,
                       const PointQualityOptions& options);

}  // namespace facet_mapping
