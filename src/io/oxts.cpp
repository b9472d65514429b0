// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oxts.h"

#include <cmath>
#include <filesystem>

#include "text_tables.h"

namespace facet_mapping {
namespace {

constexpr double kEarthRadius = 6378137.0;  // metres
constexpr double kRadians = M_PI / 180.0;
constexpr std::size_t kPacketSize = 30;

// Packet: latitude, longitude (degrees), altitude (metres), roll, pitch, yaw (radians), ...
Eigen::Isometry3d world_from_imu(const std::vector<double>& packet, double scale) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << scale * packet[1] * kRadians * kEarthRadius,
      scale * kEarthRadius * std::log(std::tan((90.0 + packet[0]) * kRadians / 2.0)), packet[2];
  pose.linear() = (Eigen::AngleAxisd(packet[5], Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(packet[4], Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(packet[3], Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  return pose;
}

}  // namespace

std::vector<Eigen::Isometry3d> read_oxts(const std::string& folder,
                                         const std::vector<std::string>& names,
                                         Problems& problems) {
  std::vector<Eigen::Isometry3d> poses;
  double scale = 0.0;
  for (const std::string& name : names) {
    const std::string path = (std::filesystem::path(folder) / (name + ".txt")).string();
    const auto rows = read_rows(path, kPacketSize, problems);
    if (rows.empty()) {
      poses.push_back(Eigen::Isometry3d::Identity());
      continue;
    }
    if (scale == 0.0) {
      scale = std::cos(rows[0][0] * kRadians);
    }
    poses.push_back(world_from_imu(rows[0], scale));
  }
  return poses;
}

}  // namespace facet_mapping
