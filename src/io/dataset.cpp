// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/io/dataset.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include "dataset_layouts.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

struct Layout {
  const char* marker;  ///< the file or folder that tells it
  const char* name;
  Dataset (*read)(const std::string& folder, Problems& problems);
};

constexpr std::array<Layout, 6> kLayouts{{
    {"cameras.json", "Strecha", read_strecha},
    {"left", "left/right images", read_plain_layout},
    {"image_2", "KITTI odometry", read_kitti_odometry},
    {"image_0", "KITTI odometry, grey", read_kitti_odometry},
    {"image_02/data", "KITTI raw drive", read_kitti_raw},
    {"image_00/data", "KITTI raw drive, grey", read_kitti_raw},
}};

const Layout& find_layout(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error("the dataset folder '" + folder + "' does not exist");
  }
  std::string markers;
  for (const Layout& layout : kLayouts) {
    if (fs::exists(fs::path(folder) / layout.marker, error)) {
      return layout;
    }
    markers += std::string(markers.empty() ? "" : ", ") + layout.marker + " (" + layout.name + ")";
  }
  throw std::runtime_error("the folder '" + folder + "' is no dataset: it holds none of " +
                           markers);
}

}  // namespace

Dataset read_dataset(const std::string& folder) {
  const Layout& layout = find_layout(folder);
  Problems problems;
  Dataset dataset = layout.read(folder, problems);
  if (problems.empty() && dataset.frames.empty()) {
    problems.add("it holds no frames");
  }
  problems.throw_if_any(folder);
  return dataset;
}

std::size_t end_frame(const Dataset& dataset, std::size_t first, std::size_t last) {
  const std::size_t count = dataset.frames.size();
  if (first >= count || last < first) {
    throw std::invalid_argument("no frame lies in the chosen range: the dataset has " +
                                std::to_string(count) + " frames, counted from 0");
  }
  return std::min(last, count - 1) + 1;
}

}  // namespace facet_mapping
