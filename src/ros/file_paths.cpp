// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/file_paths.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <ros/package.h>

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): never set by us
  return value == nullptr ? "" : value;
}

fs::path home_folder(const std::string& path) {
  const std::string home = environment("HOME");
  if (home.empty()) {
    throw std::invalid_argument("'" + path + "': HOME is not set in the node's environment; give " +
                                "an absolute path");
  }
  return home;
}

fs::path expand(const std::string& path) {
  if (path == "~" || path.rfind("~/", 0) == 0) {
    return home_folder(path) / fs::path(path).lexically_relative("~");
  }
  if (path.front() == '~') {
    throw std::invalid_argument("'" + path +
                                "': the home folders of other users are not known; "
                                "give an absolute path");
  }
  if (path.front() == '/') {
    return path;
  }
  const std::string ros_home = environment("ROS_HOME");
  return (ros_home.empty() ? home_folder(path) / ".ros" : fs::path(ros_home)) / path;
}

std::string shipped_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none found in " + folder.string() : text;
}

}  // namespace

std::string mesh_path(const std::string& path) {
  if (path.empty()) {
    throw std::invalid_argument("the path is empty; give a file, e.g. ~/mesh.ply");
  }
  fs::path expanded = expand(path).lexically_normal();
  if (path.back() == '/' || fs::is_directory(expanded)) {
    throw std::invalid_argument("'" + expanded.string() +
                                "' is a folder; give a file in it, e.g. " +
                                (expanded / "mesh.ply").string());
  }
  if (!expanded.has_extension()) {
    expanded += ".ply";
  }
  if (expanded.extension() != ".ply") {
    throw std::invalid_argument("'" + expanded.string() + "': meshes are .ply files only");
  }
  return expanded.string();
}

std::string folder_path(const std::string& path) {
  return path.empty() ? "" : expand(path).string();
}

std::string label_file_path(const std::string& name_or_path) {
  const bool is_name = name_or_path.find_first_of("/.~") == std::string::npos;
  if (!is_name) {
    return expand(name_or_path).lexically_normal().string();
  }
  const fs::path folder = fs::path(ros::package::getPath("facet_mapping")) / "config" / "labels";
  const fs::path file = folder / (name_or_path + ".yaml");
  if (name_or_path.empty() || !fs::exists(file)) {
    throw std::invalid_argument("label_file '" + name_or_path + "' is no shipped class list (" +
                                shipped_names(folder) + "); give one of them or a path");
  }
  return file.string();
}

}  // namespace facet_mapping
