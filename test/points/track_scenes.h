// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walls and a floor with texture in space, seen by one camera, with exact depth.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/label.h"

namespace facet_mapping::test {

constexpr Label kWall = 1;
constexpr Label kFloor = 2;
constexpr Label kMover = 3;
constexpr Label kFarAway = 4;

inline double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^
                    static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL ^
                    static_cast<std::uint64_t>(z) * 0x165667B19E3779F9ULL;
  h = (h ^ (h >> 31U)) * 0xBF58476D1CE4E5B9ULL;
  h ^= h >> 29U;
  return static_cast<double>(h % 10007U) / 10006.0;
}

/// Smooth noise in 0..1 with details of about `size` metres.
inline double noise_at(const Eigen::Vector3d& point, double size) {
  const Eigen::Vector3d cell = (point / size).array().floor();
  const Eigen::Vector3d t = point / size - cell;
  const Eigen::Vector3d s = t.array() * t.array() * (3.0 - 2.0 * t.array());
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1;
    const int j = (corner >> 1) & 1;
    const int k = corner >> 2;
    const double weight = (i != 0 ? s.x() : 1.0 - s.x()) * (j != 0 ? s.y() : 1.0 - s.y()) *
                          (k != 0 ? s.z() : 1.0 - s.z());
    sum += weight * lattice_value(static_cast<std::int64_t>(cell.x()) + i,
                                  static_cast<std::int64_t>(cell.y()) + j,
                                  static_cast<std::int64_t>(cell.z()) + k);
  }
  return sum;
}

struct Hit {
  double depth = std::numeric_limits<double>::infinity();  // along the optical axis, metres
  Eigen::Vector3d on_texture = Eigen::Vector3d::Zero();
  Label label = kUnlabelled;
};

/// A wall that faces the camera, as a rectangle; its texture moves with `shift`.
struct Wall {
  Eigen::Vector3d low;   // corner of smallest x and y; z for all
  Eigen::Vector2d size;  // metres
  Label label = kWall;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

/// World: x right, y down, z ahead.
struct TrackScene {
  std::vector<Wall> walls{{{-40.0, -30.0, 9.0}, {80.0, 60.0}}, {{-4.0, -3.0, 6.0}, {2.5, 6.0}}};
  double floor_y = 1.4;

  Hit hit(const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) const {
    Hit nearest;
    for (const Wall& wall : walls) {
      const double t = (wall.low.z() + wall.shift.z() - eye.z()) / ray.z();
      const Eigen::Vector3d at = eye + t * ray - wall.shift;
      const Eigen::Vector2d inside = (at - wall.low).head<2>();
      if (t > 0.0 && t < nearest.depth && (inside.array() >= 0.0).all() &&
          (inside.array() <= wall.size.array()).all()) {
        nearest = {t, at, wall.label};
      }
    }
    const double t = (floor_y - eye.y()) / ray.y();
    if (t > 0.0 && t < nearest.depth) {
      nearest = {t, eye + t * ray, kFloor};
    }
    return nearest;
  }
};

inline View track_view(const Eigen::Vector3d& eye, double yaw_rad = 0.0) {
  View view{{320, 240, 300.0, 300.0, 159.5, 119.5}, Eigen::Isometry3d::Identity()};
  view.world_from_cam.translation() = eye;
  view.world_from_cam.linear() =
      Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return view;
}

struct TrackPicture {
  View view;
  cv::Mat gray;
  cv::Mat labels;
};

/// The depth of a ray is along the optical axis if the ray's z in the camera is 1.
inline Hit hit_from(const TrackScene& scene, const View& view, const Eigen::Vector2d& pixel) {
  return scene.hit(view.center(), view.world_from_cam.linear() * view.camera.ray(pixel));
}

inline TrackPicture take_picture(const TrackScene& scene, const View& view) {
  TrackPicture picture{view,
                       cv::Mat(view.camera.height, view.camera.width, CV_8UC1),
                       cv::Mat(view.camera.height, view.camera.width, CV_16UC1)};
  for (int y = 0; y < picture.gray.rows; ++y) {
    for (int x = 0; x < picture.gray.cols; ++x) {
      const Hit hit = hit_from(scene, view, {x, y});
      const double value =
          0.6 * noise_at(hit.on_texture, 0.17) + 0.4 * noise_at(hit.on_texture, 0.41);
      picture.gray.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(20.0 + 215.0 * value);
      picture.labels.at<Label>(y, x) = hit.label;
    }
  }
  return picture;
}

}  // namespace facet_mapping::test
