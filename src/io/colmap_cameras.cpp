// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "colmap_text.h"
#include "text_tables.h"

namespace facet_mapping {
namespace {

// Parameters are the focal lengths, the principal point and then the distortion.
struct Model {
  const char* name;
  std::size_t parameters;
  std::size_t focal_lengths;
  bool is_fisheye;  // bends the image with all coefficients zero, too
};

constexpr std::array<Model, 12> kModels{{{"SIMPLE_PINHOLE", 3, 1, false},
                                         {"PINHOLE", 4, 2, false},
                                         {"SIMPLE_RADIAL", 4, 1, false},
                                         {"RADIAL", 5, 1, false},
                                         {"OPENCV", 8, 2, false},
                                         {"FULL_OPENCV", 12, 2, false},
                                         {"FOV", 5, 2, false},
                                         {"OPENCV_FISHEYE", 8, 2, true},
                                         {"SIMPLE_RADIAL_FISHEYE", 4, 1, true},
                                         {"RADIAL_FISHEYE", 5, 1, true},
                                         {"THIN_PRISM_FISHEYE", 12, 2, true},
                                         {"RAD_TAN_THIN_PRISM_FISHEYE", 16, 2, true}}};

const char* const kUndistort =
    "; run 'colmap image_undistorter' first and give the folder that it writes";

const Model* find_model(const std::string& name) {
  const auto* found = std::find_if(
      kModels.begin(), kModels.end(), [&](const Model& model) { return name == model.name; });
  return found == kModels.end() ? nullptr : found;
}

// `numbers`: width, height, parameters.
PinholeCamera camera_from(const Model& model, const std::vector<double>& numbers) {
  constexpr double kPixelCenter = 0.5;  // COLMAP's first pixel centre; ours is 0
  constexpr double kMostPixels = 1e6;
  const double* const parameters = numbers.data() + 2;
  PinholeCamera camera;
  if (numbers[0] <= kMostPixels && numbers[1] <= kMostPixels) {
    camera.width = static_cast<int>(numbers[0]);
    camera.height = static_cast<int>(numbers[1]);
  }
  camera.fx = parameters[0];
  camera.fy = parameters[model.focal_lengths - 1];
  camera.cx = parameters[model.focal_lengths] - kPixelCenter;
  camera.cy = parameters[model.focal_lengths + 1] - kPixelCenter;
  return camera;
}

bool is_distorted(const Model& model, const std::vector<double>& numbers) {
  const auto first = numbers.begin() + 2 + static_cast<std::ptrdiff_t>(model.focal_lengths) + 2;
  return model.is_fisheye ||
         std::any_of(first, numbers.end(), [](double number) { return number != 0.0; });
}

// `place` names the file and line.
PinholeCamera parse_camera(const std::string& model_name,
                           const std::string& rest,
                           const std::string& place,
                           Problems& problems) {
  const Model* const model = find_model(model_name);
  if (model == nullptr) {
    problems.add(place + " has the camera model '" + model_name +
                 "', which is no pinhole model of COLMAP" + kUndistort);
    return {};
  }
  const auto numbers = parse_numbers(rest);
  const std::string fault = row_fault(numbers, 2 + model->parameters);
  if (!fault.empty()) {
    problems.add(place + " " + fault + " (WIDTH HEIGHT and the " +
                 std::to_string(model->parameters) + " parameters of " + model_name + ")");
    return {};
  }
  if (is_distorted(*model, *numbers)) {
    problems.add(place + " is a camera with distortion (" + model_name + ")" + kUndistort);
    return {};
  }
  const PinholeCamera camera = camera_from(*model, *numbers);
  if (!camera.is_valid()) {
    problems.add(place + ": size and focal lengths must be positive");
    return {};
  }
  return camera;
}

}  // namespace

std::map<std::string, PinholeCamera> read_colmap_cameras(const std::string& path,
                                                         Problems& problems) {
  std::map<std::string, PinholeCamera> cameras;
  std::ifstream input(path);
  if (!input) {
    problems.add_missing(path);
    return cameras;
  }
  int line = 0;
  for (std::string text; std::getline(input, text);) {
    ++line;
    std::istringstream words(text);
    std::string id;
    std::string model;
    std::string rest;
    if (!(words >> id) || id.front() == '#') {
      continue;
    }
    words >> model;
    std::getline(words, rest);
    const std::string place = path + " line " + std::to_string(line);
    if (!cameras.emplace(id, parse_camera(model, rest, place, problems)).second) {
      problems.add(place + " gives the camera id " + id + " again");
    }
  }
  if (cameras.empty()) {
    problems.add(path + " holds no cameras");
  }
  return cameras;
}

}  // namespace facet_mapping
