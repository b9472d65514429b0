// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "colmap_text.h"
#include "text_tables.h"

namespace facet_mapping {
namespace {

constexpr const char* kSpaces = " \t\r";

bool is_blank(const std::string& text) {
  return text.find_first_not_of(kSpaces) == std::string::npos;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kSpaces);
  return first == std::string::npos
             ? std::string()
             : text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

std::optional<Eigen::Isometry3d> pose_from(const std::vector<double>& numbers) {
  constexpr double kUnitTolerance = 1e-3;
  const Eigen::Quaterniond rotation(numbers[0], numbers[1], numbers[2], numbers[3]);
  if (std::abs(rotation.norm() - 1.0) > kUnitTolerance) {
    return std::nullopt;
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() << numbers[4], numbers[5], numbers[6];
  return pose;
}

// IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME; the name may hold spaces.
ColmapImage parse_image(const std::string& text, const std::string& place, Problems& problems) {
  std::istringstream words(text);
  std::string word;
  std::string pose_text;
  words >> word;
  for (int k = 0; k < 7 && words >> word; ++k) {
    pose_text += word + " ";
  }
  ColmapImage image;
  words >> image.camera_id;
  std::getline(words, image.name);
  image.name = trimmed(image.name);
  if (image.name.empty()) {
    problems.add(
        place + " is no row 'IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME' (is the file cut off?)");
    return image;
  }
  const auto numbers = parse_numbers(pose_text);
  const std::string fault = row_fault(numbers, 7);
  const auto pose = fault.empty() ? pose_from(*numbers) : std::nullopt;
  if (!fault.empty()) {
    problems.add(place + " " + fault + " (QW QX QY QZ TX TY TZ)");
  } else if (!pose) {
    problems.add(place + " has a quaternion QW QX QY QZ whose length is not 1");
  }
  image.cam_from_world = pose.value_or(image.cam_from_world);
  return image;
}

// The points are not needed, but a row that is none shows that rows were lost.
void check_points_row(const std::string& text, const std::string& place, Problems& problems) {
  if (text.find_first_not_of("0123456789+-.eEnaif \t\r") != std::string::npos) {
    problems.add(place +
                 " must hold the 2D points of the image above (X Y POINT3D_ID ..., or nothing), "
                 "but holds a word; the rows of images and points take turns");
  }
}

// N of '# Number of images: N', else nothing.
std::optional<std::size_t> stated_count(const std::string& comment) {
  const std::string key = "Number of images:";
  const std::size_t at = comment.find(key);
  std::size_t count = 0;
  if (at == std::string::npos || !(std::istringstream(comment.substr(at + key.size())) >> count)) {
    return std::nullopt;
  }
  return count;
}

struct ImageTable {
  std::vector<ColmapImage> images;
  std::optional<std::size_t> stated;
};

ImageTable read_table(std::istream& input, const std::string& path, Problems& problems) {
  ImageTable table;
  int line = 0;
  const auto place = [&] { return path + " line " + std::to_string(line); };
  for (std::string text; std::getline(input, text);) {
    ++line;
    if (is_blank(text)) {
      continue;
    }
    if (trimmed(text).front() == '#') {
      table.stated = table.stated ? table.stated : stated_count(text);
      continue;
    }
    table.images.push_back(parse_image(text, place(), problems));
    if (std::getline(input, text)) {
      ++line;
      check_points_row(text, place(), problems);
    }
  }
  return table;
}

void check_table(const ImageTable& table, const std::string& path, Problems& problems) {
  const std::vector<ColmapImage>& images = table.images;
  if (images.empty()) {
    problems.add(path + " holds no images");
  }
  if (table.stated && *table.stated != images.size()) {
    problems.add(path + " says that it has " + std::to_string(*table.stated) +
                 " images, but holds " + std::to_string(images.size()) +
                 " (cut off? If not, correct the comment 'Number of images')");
  }
  for (std::size_t k = 1; k < images.size(); ++k) {
    if (!images[k].name.empty() && images[k].name == images[k - 1].name) {
      problems.add(path + " has the image '" + images[k].name + "' twice");
    }
  }
}

}  // namespace

std::vector<ColmapImage> read_colmap_images(const std::string& path, Problems& problems) {
  std::ifstream input(path);
  if (!input) {
    problems.add_missing(path);
    return {};
  }
  ImageTable table = read_table(input, path, problems);
  std::stable_sort(table.images.begin(),
                   table.images.end(),
                   [](const ColmapImage& a, const ColmapImage& b) { return a.name < b.name; });
  check_table(table, path, problems);
  return table.images;
}

}  // namespace facet_mapping
