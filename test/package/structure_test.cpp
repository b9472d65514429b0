// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Holds the architecture: which room may include which, and that the core knows no ROS.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kMayInclude{
    {"geometry", {}},
    {"labels", {"geometry"}},
    {"points", {"geometry", "labels"}},
    {"segmentation", {"geometry", "labels", "io"}},
    {"render", {"geometry", "labels"}},
    {"carving", {"geometry", "labels", "points"}},
    {"labeling", {"geometry", "labels", "render"}},
    {"refinement", {"geometry", "labels", "render", "labeling"}},
    {"mapping",
     {"geometry", "labels", "points", "render", "carving", "labeling", "refinement", "io"}},
    {"io", {"geometry", "labels", "points"}},
    {"evaluation", {"geometry", "labels", "points", "render", "io"}},
    {"synthetic", {"geometry", "labels", "points", "render", "io"}},
};

/// Outside the core; nothing of the core may include them. That a path may be one of ROS itself or
/// of rviz itself does no harm: those are as far from the core.
const std::map<std::string, std::set<std::string>> kMayIncludeWithRos{
    {"ros",
     {"geometry",
      "labels",
      "points",
      "segmentation",
      "render",
      "labeling",
      "refinement",
      "mapping",
      "io"}},
    {"rviz", {"geometry", "mapping", "ros"}},
};

struct Include {
  fs::path file;
  std::string target;
};

std::vector<fs::path> sources_of(const std::string& room) {
  std::vector<fs::path> files;
  const fs::path root(FACET_MAPPING_SOURCE_DIR);
  for (const fs::path& folder : {root / "src" / room, root / "include/facet_mapping" / room}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") {
        files.push_back(entry.path());
      }
    }
  }
  return files;
}

std::vector<Include> includes_of(const std::string& room) {
  std::vector<Include> includes;
  const std::regex pattern("^#include [<\"](.*)[>\"]");
  for (const fs::path& file : sources_of(room)) {
    std::ifstream stream(file);
    std::string line;
    std::smatch match;
    while (std::getline(stream, line)) {
      if (std::regex_search(line, match, pattern)) {
        includes.push_back({file, match[1]});
      }
    }
  }
  return includes;
}

/// The room that an include path belongs to, empty if it is not one of ours.
std::string room_of(const std::string& target) {
  std::smatch match;
  if (std::regex_search(target, match, std::regex("^(?:facet_mapping/)?([a-z]+)/")) &&
      (kMayInclude.count(match[1]) > 0 || kMayIncludeWithRos.count(match[1]) > 0)) {
    return match[1];
  }
  return {};
}

TEST(Structure, RoomsIncludeOneWay) {
  auto rooms = kMayInclude;
  rooms.insert(kMayIncludeWithRos.begin(), kMayIncludeWithRos.end());
  for (const auto& [room, allowed] : rooms) {
    const std::vector<Include> includes = includes_of(room);
    EXPECT_FALSE(includes.empty()) << room;
    for (const Include& include : includes) {
      const std::string other = room_of(include.target);
      EXPECT_TRUE(other.empty() || other == room || allowed.count(other) > 0)
          << include.file << " includes " << include.target;
    }
  }
}

TEST(Structure, TheCoreIncludesNoRos) {
  const std::regex ros(
      "^(ros/|rosbag/|tf2|tf2_ros/|sensor_msgs/|std_msgs/|geometry_msgs/|visualization_msgs/|"
      "facet_mapping/ros/|facet_mapping/[A-Z]|nodelet/|pluginlib/|cv_bridge/|message_filters/)");
  for (const auto& [room, allowed] : kMayInclude) {
    for (const Include& include : includes_of(room)) {
      EXPECT_FALSE(std::regex_search(include.target, ros))
          << include.file << " includes " << include.target;
    }
  }
}

TEST(Structure, HeavyHeadersStayOutOfPublicHeaders) {
  const std::regex heavy("^(CGAL/|pcl/|rviz/)");
  const fs::path root = fs::path(FACET_MAPPING_SOURCE_DIR) / "include";
  for (const auto& [room, allowed] : kMayInclude) {
    for (const Include& include : includes_of(room)) {
      const bool is_public = include.file.string().rfind(root.string(), 0) == 0;
      EXPECT_FALSE(is_public && std::regex_search(include.target, heavy)) << include.file;
    }
  }
}

TEST(Structure, FilesStaySmall) {
  for (const char* folder : {"src", "include", "test"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(FACET_MAPPING_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") {
        continue;
      }
      std::ifstream stream(entry.path());
      std::size_t lines = 0;
      for (std::string line; std::getline(stream, line);) {
        ++lines;
      }
      EXPECT_LE(lines, 400U) << entry.path();
    }
  }
}

}  // namespace
