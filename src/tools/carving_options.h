// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The carving's parameters on a command line.
#pragma once

#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "facet_mapping/carving/space_carver.h"

namespace facet_mapping {

/// A parameter that is a number, with its option. `edges`: for --fit-scale, its value in median
/// edges of the points' mesh; 0 = it is no length.
struct CarvingOption {
  const char* name;
  double CarvingConfig::*value;
  double edges;
  const char* help;
};

inline const std::vector<CarvingOption>& carving_options() {
  static const std::vector<CarvingOption> options{
      {"--quality-weight",
       &CarvingConfig::surface_quality_weight,
       0.0,
       "Graph cut: cost of a badly shaped facet, rays"},
      {"--evidence-cap",
       &CarvingConfig::evidence_cap,
       0.0,
       "Graph cut: where a cell has more evidence, rays, it is scaled down to this"},
      {"--free-space-threshold",
       &CarvingConfig::free_space_threshold,
       0.0,
       "Least free-space evidence of a free cell, rays"},
      {"--behind-distance",
       &CarvingConfig::behind_distance_m,
       4.0,
       "How far behind a point its class is evidence, metres"},
      {"--steiner-spacing",
       &CarvingConfig::steiner_spacing_m,
       120.0,
       "Spacing of the extra vertices that bound cells, metres; 0: none"},
      {"--steiner-reach",
       &CarvingConfig::steiner_reach_m,
       1500.0,
       "How far around a sensor extra vertices are laid, metres"},
      {"--steiner-clearance",
       &CarvingConfig::steiner_clearance_m,
       10.0,
       "Extra vertices keep this far from points, metres"},
      {"--max-facet-edge",
       &CarvingConfig::max_facet_edge_m,
       50.0,
       "Facets with a longer edge only close the surface, metres"},
      {"--point-spacing",
       &CarvingConfig::min_point_spacing_m,
       0.1,
       "A point nearer to a vertex than this joins it, metres"},
  };
  return options;
}

inline void add_carving_options(CLI::App& app, CarvingConfig& config) {
  const std::map<std::string, Extraction> extractions{{"graph_cut", Extraction::kGraphCut},
                                                      {"count", Extraction::kCount}};
  app.add_option("--extraction", config.extraction, "How cells are called free")
      ->transform(CLI::CheckedTransformer(extractions))
      ->default_str("graph_cut");
  for (const CarvingOption& option : carving_options()) {
    app.add_option(option.name, config.*option.value, option.help)
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
  }
}

/// Sets the lengths that were not given by multiples of `edge_m`.
inline void fit_scale(const CLI::App& app, double edge_m, CarvingConfig* config) {
  for (const CarvingOption& option : carving_options()) {
    if (option.edges > 0.0 && app.count(option.name) == 0) {
      config->*option.value = option.edges * edge_m;
    }
  }
}

inline void print_config(const CarvingConfig& config) {
  std::cout << "carving: " << (config.extraction == Extraction::kCount ? "count" : "graph_cut");
  for (const CarvingOption& option : carving_options()) {
    std::cout << ' ' << option.name + 2 << ' ' << config.*option.value;
  }
  std::cout << '\n';
}

}  // namespace facet_mapping
