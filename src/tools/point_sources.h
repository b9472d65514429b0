// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The sources of points that programs choose from by name.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "facet_mapping/mapping/dataset_points.h"

namespace facet_mapping {

struct PointSource {
  std::string name;
  bool DatasetPointsConfig::*wanted;
  std::string what;
};

inline const std::vector<PointSource>& point_sources() {
  static const std::vector<PointSource> kSources{
      {"stereo", &DatasetPointsConfig::stereo, "the stereo pair"},
      {"lidar", &DatasetPointsConfig::lidar, "the LiDAR scans"},
      {"tracks", &DatasetPointsConfig::tracks, "features followed through the left images"},
      {"sweep", &DatasetPointsConfig::sweep, "plane sweeping between the left images"}};
  return kSources;
}

/// The configuration with exactly these sources wanted.
inline DatasetPointsConfig with_sources(DatasetPointsConfig config,
                                        const std::vector<std::string>& names) {
  for (const PointSource& source : point_sources()) {
    config.*source.wanted = std::find(names.begin(), names.end(), source.name) != names.end();
  }
  return config;
}

/// --points NAME[,NAME...]
inline CLI::Option* add_points_option(CLI::App& app, std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::string help = "Where points come from, one or several of";
  for (const PointSource& source : point_sources()) {
    known.push_back(source.name);
    help += (known.size() > 1 ? ", " : " ") + source.name + " (" + source.what + ")";
  }
  return app.add_option("--points", names, help)->delimiter(',')->check(CLI::IsMember(known));
}

}  // namespace facet_mapping
