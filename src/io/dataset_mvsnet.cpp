// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// MVSNet (Yao et al. 2018), the usual form of DTU: cams/00000000_cam.txt, images/00000000.jpg.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "dataset_layouts.h"
#include "dataset_views.h"
#include "text_tables.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

const std::string kSuffix = "_cam.txt";

// "00000003" of every 00000003_cam.txt, in order.
std::set<std::string> camera_names(const std::string& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > kSuffix.size() &&
        name.compare(name.size() - kSuffix.size(), kSuffix.size(), kSuffix) == 0) {
      names.insert(name.substr(0, name.size() - kSuffix.size()));
    }
  }
  return names;
}

std::vector<std::string> read_words(const std::string& path) {
  std::ifstream input(path);
  std::vector<std::string> words;
  for (std::string word; input >> word;) {
    words.push_back(word);
  }
  return words;
}

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The square matrix below the word `key`; empty, and a problem, if it is not there.
Eigen::MatrixXd matrix_after(const std::vector<std::string>& words,
                             const std::string& key,
                             std::ptrdiff_t size,
                             const std::string& path,
                             Problems& problems) {
  const auto found = std::find(words.begin(), words.end(), key);
  const std::ptrdiff_t rest = found == words.end() ? 0 : words.end() - found - 1;
  std::string text;
  for (std::ptrdiff_t k = 1; k <= std::min(rest, size * size); ++k) {
    text += found[k] + " ";
  }
  const auto numbers = parse_numbers(text);
  const std::string fault = row_fault(numbers, static_cast<std::size_t>(size * size));
  if (found == words.end()) {
    problems.add(path + " has no line '" + key + "'");
  } else if (!fault.empty()) {
    problems.add(path + ": '" + key + "' " + fault);
  } else {
    return Eigen::Map<const RowMatrix>(numbers->data(), size, size);
  }
  return {};
}

View read_view(const std::string& path, Problems& problems) {
  View view;
  const std::vector<std::string> words = read_words(path);
  const Eigen::MatrixXd extrinsic = matrix_after(words, "extrinsic", 4, path, problems);
  const Eigen::MatrixXd intrinsic = matrix_after(words, "intrinsic", 3, path, problems);
  if (extrinsic.size() > 0) {
    const auto cam_from_world =
        rigid_from(extrinsic.topLeftCorner<3, 3>(), extrinsic.topRightCorner<3, 1>());
    if (!cam_from_world || !extrinsic.row(3).isApprox(Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))) {
      problems.add(path + ": 'extrinsic' is no rigid transform (a rotation and 0 0 0 1 below)");
    } else {
      view.world_from_cam = cam_from_world->inverse(Eigen::Isometry);
    }
  }
  if (intrinsic.size() > 0) {
    view.camera = camera_from_matrix(intrinsic, path, problems);
  }
  return view;
}

std::string camera_folder(const std::string& folder) {
  return first_folder(folder, {"cams", "cams_1"});
}

std::string image_folder(const std::string& folder) {
  return first_folder(folder, {"images", "blended_images"});
}

void check_images_have_cameras(const std::string& images,
                               const std::string& cameras,
                               const std::set<std::string>& names,
                               Problems& problems) {
  for (const std::string& name : image_names(images)) {
    if (names.count(name) == 0) {
      problems.add_missing(cameras + "/" + name + kSuffix + " (its image is there)");
    }
  }
}

}  // namespace

bool is_mvsnet(const std::string& folder) {
  return !camera_names(camera_folder(folder)).empty();
}

Dataset read_mvsnet(const std::string& folder, Problems& problems) {
  Dataset dataset;
  const std::string cameras = camera_folder(folder);
  const std::string images = image_folder(folder);
  if (images.empty()) {
    problems.add_missing(folder + "/images (the folder of the images of " + cameras + ")");
    return dataset;
  }
  const FrameFolders others = view_folders(folder);
  dataset.depth_scale = read_depth_scale(others, 0.0, problems);
  const std::set<std::string> names = camera_names(cameras);
  for (const std::string& name : names) {
    const std::string path = cameras + "/" + name + kSuffix;
    DatasetFrame frame;
    frame.stamp = static_cast<double>(dataset.frames.size());
    frame.view = read_view(path, problems);
    frame.left_image = find_image(images, name);
    find_view_files(others, name, frame);
    if (frame.left_image.empty()) {
      problems.add_missing(images + "/" + name + ".jpg (or .png)");
    } else {
      set_size_of_image(path, frame, problems);
    }
    dataset.frames.push_back(frame);
  }
  check_images_have_cameras(images, cameras, names, problems);
  return dataset;
}

}  // namespace facet_mapping
