// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset_files.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/io/atomic_file.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char* name;
  const char* extension;
};
constexpr std::array<Kind, 6> kKinds{{{"left", ".png"},
                                      {"right", ".png"},
                                      {"labels", ".png"},
                                      {"gt_label", ".png"},
                                      {"gt_depth", ".png"},
                                      {"velodyne", ".bin"}}};

std::string frame_name(std::size_t frame, const char* extension) {
  std::ostringstream name;
  name << std::setw(6) << std::setfill('0') << frame << extension;
  return name.str();
}

void write_bytes(const std::string& path, const void* data, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  file.close();
  if (!file) {
    throw std::runtime_error(path + ": cannot be written (" + std::strerror(errno) +
                             "); free some space or give another folder");
  }
}

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

std::string row_major(const Eigen::Isometry3d& transform) {
  std::ostringstream text;
  text << std::setprecision(15);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      text << (r + c > 0 ? " " : "") << transform(r, c);
    }
  }
  return text.str();
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    throw std::runtime_error(path + ": cannot be made (" + error.message() +
                             "); give a folder that may be written");
  }
}

}  // namespace

DatasetFiles::DatasetFiles(const std::string& folder, std::size_t frames) : folder_(folder) {
  for (const Kind& kind : kKinds) {
    make_folder(path(kind.name));
    const std::string next = path(kind.name) + "/" + frame_name(frames, kind.extension);
    if (fs::exists(next)) {
      throw std::runtime_error(next + " belongs to a longer dataset; remove " + folder_ +
                               " or give another folder");
    }
  }
  std::error_code ignored;  // a folder without poses.txt is as it should be
  fs::remove(path("poses.txt"), ignored);
}

void DatasetFiles::write_image(const char* kind, std::size_t frame, const cv::Mat& image) const {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  write_bytes(path(kind) + "/" + frame_name(frame, ".png"), bytes.data(), bytes.size());
}

void DatasetFiles::write_scan(std::size_t frame, const std::vector<Eigen::Vector4f>& scan) const {
  static_assert(sizeof(Eigen::Vector4f) == 16, "x y z intensity as float32");
  write_bytes(path("velodyne") + "/" + frame_name(frame, ".bin"), scan.data(), 16 * scan.size());
}

void DatasetFiles::write_calibration(const StreetRig& rig) const {
  const PinholeCamera& c = rig.camera;
  std::ostringstream text;
  text << std::setprecision(15);
  text << "K: " << c.fx << " 0 " << c.cx << " 0 " << c.fy << ' ' << c.cy << " 0 0 1\n";
  text << "T_right_left: " << row_major(rig.right_from_left()) << '\n';
  text << "T_left_velo: " << row_major(rig.left_from_velo) << '\n';
  text << "baseline_m: " << rig.baseline_m << '\n';
  write_text(path("calib.txt"), text.str());
}

void DatasetFiles::write_times(const std::vector<StreetPose>& poses) const {
  std::ostringstream text;
  text << std::fixed << std::setprecision(6);
  for (const StreetPose& pose : poses) {
    text << pose.stamp << '\n';
  }
  write_text(path("times.txt"), text.str());
}

void DatasetFiles::write_poses(const std::vector<StreetPose>& poses) const {
  const Eigen::Isometry3d world_from_map = poses.front().map_from_left.inverse();
  std::ostringstream text;
  for (const StreetPose& pose : poses) {
    text << row_major(world_from_map * pose.map_from_left) << '\n';
  }
  write_text(path("poses.txt"), text.str());
}

}  // namespace facet_mapping
