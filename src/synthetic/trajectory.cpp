// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "trajectory.h"

#include <cmath>

#include "noise.h"
#include "random.h"

namespace facet_mapping {
namespace {

constexpr double kSway = 0.03;         // metres
constexpr double kHeave = 0.012;       // metres
constexpr double kTilt = 0.004;        // radians
constexpr double kSettleMetres = 5.0;  // the jitter grows from none over this distance

/// Axes of the optical frame (x right, y down, z forward) in a body frame (x forward, y left).
Eigen::Matrix3d body_from_optical() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1,  //
      -1, 0, 0,         //
      0, -1, 0;
  return rotation;
}

}  // namespace

int fitting_frames(const StreetConfig& config) {
  return 1 + static_cast<int>((config.length_m - kStreetEndMargin) / config.frame_spacing_m);
}

std::vector<StreetPose> drive(const StreetConfig& config, const Centerline& line) {
  Random random(derive_seed(config.seed, 7));
  const std::uint32_t seed = random.bits32();
  const int frames = config.frames > 0 ? config.frames : fitting_frames(config);
  std::vector<StreetPose> poses;
  for (int k = 0; k < frames; ++k) {
    const double s = k * config.frame_spacing_m;
    const double settle = std::min(1.0, s / kSettleMetres) * config.pose_jitter;
    const auto wobble = [&](float wavelength, int channel) {
      const Eigen::Vector3f p(static_cast<float>(s) / wavelength, 0.3F, 0.7F);
      return settle * gradient_noise(p, seed + static_cast<std::uint32_t>(channel));
    };
    const double t = cross_section::kLane + kSway * wobble(12.0F, 0);
    const double h = config.camera_height_m + line.ground_height(cross_section::kLane) +
                     kHeave * wobble(4.0F, 1);
    Eigen::Isometry3d body = line.frame(s, t, h, kTilt * wobble(9.0F, 2));
    body.rotate(Eigen::AngleAxisd(kTilt * wobble(4.0F, 3), Eigen::Vector3d::UnitY()));
    body.rotate(Eigen::AngleAxisd(kTilt * wobble(5.0F, 4), Eigen::Vector3d::UnitX()));
    StreetPose pose;
    pose.stamp = k / config.frame_rate_hz;
    pose.map_from_left = body;
    pose.map_from_left.linear() = body.linear() * body_from_optical();
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace facet_mapping
