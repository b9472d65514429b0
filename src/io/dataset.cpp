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
  bool (*is_layout)(const std::string& folder);  ///< null: the marker exists
  Dataset (*read)(const std::string& folder, Problems& problems);
};

constexpr std::array<Layout, 9> kLayouts{{
    {"cameras.json", "Strecha", nullptr, read_strecha},
    {"left", "left/right images", nullptr, read_plain_layout},
    {"image_2", "KITTI odometry", nullptr, read_kitti_odometry},
    {"image_0", "KITTI odometry, grey", nullptr, read_kitti_odometry},
    {"image_02/data", "KITTI raw drive", nullptr, read_kitti_raw},
    {"image_00/data", "KITTI raw drive, grey", nullptr, read_kitti_raw},
    {"[sparse/[0/]]cameras.txt", "COLMAP text model", is_colmap, read_colmap},
    {"cams/00000000_cam.txt", "MVSNet, DTU", is_mvsnet, read_mvsnet},
    {"[images/]rect_001_max.png or rect_001_3_r5000.png", "DTU", is_dtu, read_dtu},
}};

bool has_layout(const std::string& folder, const Layout& layout) {
  std::error_code error;
  return layout.is_layout != nullptr ? layout.is_layout(folder)
                                     : fs::exists(fs::path(folder) / layout.marker, error);
}

const Layout& find_layout(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error("the dataset folder '" + folder + "' does not exist");
  }
  std::string markers;
  for (const Layout& layout : kLayouts) {
    if (has_layout(folder, layout)) {
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

std::string dataset_layouts_help() {
  std::string text = "Dataset folders, told apart by what they hold:";
  for (const Layout& layout : kLayouts) {
    text += std::string("\n  ") + layout.name + ": " + layout.marker;
  }
  return text;
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
