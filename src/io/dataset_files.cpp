// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset_files.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> kImageExtensions{".png", ".jpg", ".jpeg", ".JPG"};

bool is_image(const fs::path& path) {
  return std::find(kImageExtensions.begin(), kImageExtensions.end(), path.extension().string()) !=
         kImageExtensions.end();
}

// True if the names are numbers with the same number of digits: KITTI's way.
bool are_numbers(const std::set<std::string>& names) {
  constexpr std::size_t kMostDigits = 12;
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return name.size() == names.begin()->size() && name.size() <= kMostDigits &&
           std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
  });
}

std::string padded(unsigned long long number, std::size_t digits) {
  std::string text = std::to_string(number);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

std::string found(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) ? path : std::string();
}

void find_frame(const FrameFolders& folders,
                const std::string& name,
                DatasetFrame& frame,
                Problems& problems) {
  frame.left_image = find_image(folders.left, name);
  frame.right_image = find_image(folders.right, name);
  frame.labels = find_image(folders.labels, name);
  frame.gt_labels = find_image(folders.gt_labels, name);
  frame.gt_depth = find_image(folders.gt_depth, name);
  frame.scan = folders.scans.empty() ? "" : found(folders.scans + "/" + name + ".bin");
  if (!folders.right.empty() && frame.right_image.empty()) {
    problems.add_missing(folders.right + "/" + name + ".png (the folder holds the right images)");
  }
}

}  // namespace

std::set<std::string> image_names(const std::string& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (is_image(entry.path())) {
      names.insert(entry.path().stem().string());
    }
  }
  return names;
}

std::vector<std::string> frame_names(const std::string& image_folder,
                                     std::size_t count,
                                     const std::string& counted_by,
                                     Problems& problems) {
  const std::set<std::string> names = image_names(image_folder);
  if (names.empty()) {
    problems.add(image_folder + " holds no images (.png or .jpg)");
    return {};
  }
  if (names.size() > count || (!are_numbers(names) && names.size() != count)) {
    problems.add(image_folder + " holds " + std::to_string(names.size()) + " images, but " +
                 counted_by + " has " + std::to_string(count) + " entries");
  }
  if (!are_numbers(names)) {
    return {names.begin(), names.end()};
  }
  const bool from_zero = std::stoull(*names.rbegin()) < count;
  const unsigned long long first = from_zero ? 0 : std::stoull(*names.begin());
  std::vector<std::string> expected;
  for (std::size_t k = 0; k < count; ++k) {
    expected.push_back(padded(first + k, names.begin()->size()));
    if (names.count(expected.back()) == 0) {
      problems.add_missing(image_folder + "/" + expected.back() + ".png");
    }
  }
  return expected;
}

std::string find_image(const std::string& folder, const std::string& name) {
  for (const char* extension : kImageExtensions) {
    std::string path = folder;
    path.append("/").append(name).append(extension);
    if (!folder.empty() && !found(path).empty()) {
      return path;
    }
  }
  return "";
}

void find_files(const FrameFolders& folders,
                const std::vector<std::string>& names,
                Dataset& dataset,
                Problems& problems) {
  for (std::size_t k = 0; k < std::min(names.size(), dataset.frames.size()); ++k) {
    find_frame(folders, names[k], dataset.frames[k], problems);
    dataset.has_scans = dataset.has_scans || !dataset.frames[k].scan.empty();
  }
  dataset.has_right = !folders.right.empty();
}

std::string first_folder(const std::string& parent, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::string path = (fs::path(parent) / name).string();
    std::error_code error;
    if (fs::is_directory(path, error)) {
      return path;
    }
  }
  return "";
}

}  // namespace facet_mapping
