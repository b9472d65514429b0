// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// COLMAP: images/ with a text model in sparse/0/, sparse/ or the folder itself.
#include <array>
#include <filesystem>
#include <stdexcept>

#include "colmap_text.h"
#include "dataset_layouts.h"
#include "dataset_views.h"
#include "image_size.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// The first folder with one of the model's files; empty if there is none.
std::string model_folder(const std::string& folder, const std::string& extension) {
  for (const char* place : {"/sparse/0", "/sparse", ""}) {
    std::string model = folder + place;
    if (exists(model + "/cameras" + extension) || exists(model + "/images" + extension)) {
      return model;
    }
  }
  return "";
}

void check_size(const DatasetFrame& frame, Problems& problems) {
  const PinholeCamera& camera = frame.view.camera;
  if (!camera.is_valid()) {
    return;  // a problem of its own
  }
  try {
    const cv::Size size = read_image_size(frame.left_image);
    if (size != cv::Size(camera.width, camera.height)) {
      problems.add(frame.left_image + " has " + std::to_string(size.width) + "x" +
                   std::to_string(size.height) + " pixels, but its camera in cameras.txt " +
                   std::to_string(camera.width) + "x" + std::to_string(camera.height) +
                   "; give images of the model's size (they were scaled?)");
    }
  } catch (const std::runtime_error& error) {
    problems.add(error.what());
  }
}

struct Model {
  std::string images_path;  // images.txt
  std::string image_folder;
  std::map<std::string, PinholeCamera> cameras;
  FrameFolders others;
};

DatasetFrame make_frame(const ColmapImage& image, const Model& model, Problems& problems) {
  DatasetFrame frame;
  const auto camera = model.cameras.find(image.camera_id);
  if (camera != model.cameras.end()) {
    frame.view.camera = camera->second;
  } else if (!model.cameras.empty()) {
    problems.add(model.images_path + ": the image '" + image.name + "' has the camera id " +
                 image.camera_id + ", which cameras.txt does not know");
  }
  frame.view.world_from_cam = image.cam_from_world.inverse(Eigen::Isometry);
  frame.left_image = model.image_folder + "/" + image.name;
  find_view_files(model.others, fs::path(image.name).replace_extension().string(), frame);
  if (!exists(frame.left_image)) {
    problems.add_missing(frame.left_image);
  } else {
    check_size(frame, problems);
  }
  return frame;
}

}  // namespace

bool is_colmap(const std::string& folder) {
  return !model_folder(folder, ".txt").empty() || !model_folder(folder, ".bin").empty();
}

Dataset read_colmap(const std::string& folder, Problems& problems) {
  constexpr double kDepthScale = 2000.0;  // as the Strecha layout
  Dataset dataset;
  const std::string place = model_folder(folder, ".txt");
  if (place.empty()) {
    const std::string binary = model_folder(folder, ".bin");
    problems.add("the COLMAP model in " + binary +
                 " is binary; run 'colmap model_converter --input_path " + binary +
                 " --output_path " + binary + " --output_type TXT'");
    return dataset;
  }
  Model model;
  model.images_path = place + "/images.txt";
  model.image_folder = folder + "/images";
  model.cameras = read_colmap_cameras(place + "/cameras.txt", problems);
  model.others = view_folders(folder);
  const std::vector<ColmapImage> images = read_colmap_images(model.images_path, problems);
  if (!exists(model.image_folder)) {
    problems.add_missing(model.image_folder + " (the folder of the images in images.txt)");
    return dataset;
  }
  dataset.depth_scale = read_depth_scale(model.others, kDepthScale, problems);
  for (const ColmapImage& image : images) {
    if (!image.name.empty()) {
      dataset.frames.push_back(make_frame(image, model, problems));
      dataset.frames.back().stamp = static_cast<double>(dataset.frames.size() - 1);
    }
  }
  return dataset;
}

}  // namespace facet_mapping
