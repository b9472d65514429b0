// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Strecha: cameras.json with images/, depth_gt/, labels_gt/, segmentation/.
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "dataset_layouts.h"
#include "dataset_views.h"
#include "text_tables.h"
#include <nlohmann/json.hpp>

namespace facet_mapping {
namespace {

using nlohmann::json;

// Throws json exceptions and std::runtime_error on what is missing or wrong.
Eigen::Isometry3d read_pose(const json& view) {
  const json& rows = view.at("rotation_cam_from_world");
  const json& shift = view.at("translation_cam_from_world");
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      rotation(static_cast<int>(row), static_cast<int>(column)) =
          rows.at(row).at(column).get<double>();
    }
    translation[static_cast<int>(row)] = shift.at(row).get<double>();
  }
  const auto cam_from_world = rigid_from(rotation, translation);
  if (!cam_from_world) {
    throw std::runtime_error("its pose is no rigid transform");
  }
  return cam_from_world->inverse(Eigen::Isometry);
}

View read_view(const json& entry) {
  View view;
  view.camera.width = entry.at("width").get<int>();
  view.camera.height = entry.at("height").get<int>();
  view.camera.fx = entry.at("fx").get<double>();
  view.camera.fy = entry.at("fy").get<double>();
  view.camera.cx = entry.at("cx").get<double>();
  view.camera.cy = entry.at("cy").get<double>();
  view.world_from_cam = read_pose(entry);
  if (!view.camera.is_valid()) {
    throw std::runtime_error("its size and focal lengths must be positive");
  }
  return view;
}

void read_frame(const json& entry,
                const std::string& folder,
                const FrameFolders& folders,
                DatasetFrame& frame,
                Problems& problems) {
  frame.view = read_view(entry);
  const std::string image = entry.at("image").get<std::string>();
  frame.left_image = folder + "/" + image;
  find_view_files(folders, std::filesystem::path(image).stem().string(), frame);
  std::error_code error;
  if (!std::filesystem::is_regular_file(frame.left_image, error)) {
    problems.add_missing(frame.left_image);
  }
}

void read_frames(const json& views,
                 const std::string& folder,
                 Dataset& dataset,
                 Problems& problems) {
  const FrameFolders folders = view_folders(folder);
  for (const json& entry : views) {
    DatasetFrame frame;
    frame.stamp = static_cast<double>(dataset.frames.size());
    try {
      read_frame(entry, folder, folders, frame, problems);
    } catch (const std::exception& error) {
      problems.add(folder + "/cameras.json: view " + std::to_string(dataset.frames.size()) + ": " +
                   error.what());
    }
    dataset.frames.push_back(frame);
  }
}

}  // namespace

Dataset read_strecha(const std::string& folder, Problems& problems) {
  Dataset dataset;
  dataset.depth_scale = 2000.0;
  const std::string path = folder + "/cameras.json";
  try {
    std::ifstream input(path);
    const json content = json::parse(input);
    const json& views = content.at("views");
    if (!views.is_array() || views.empty()) {
      throw std::runtime_error("'views' must be a list that is not empty");
    }
    read_frames(views, folder, dataset, problems);
  } catch (const std::exception& error) {
    problems.add(path + ": " + error.what());
  }
  return dataset;
}

}  // namespace facet_mapping
