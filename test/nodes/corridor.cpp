// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "corridor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace facet_mapping::test {
namespace {

struct Hit {
  Eigen::Vector2d texture = Eigen::Vector2d::Zero();  ///< metres on the surface
  Label label = kRoad;
};

double lattice_value(std::int64_t i, std::int64_t j) {
  std::uint64_t hash = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ULL +
                       static_cast<std::uint64_t>(j) * 0xC2B2AE3D27D4EB4FULL;
  hash ^= hash >> 29;
  hash *= 0xBF58476D1CE4E5B9ULL;
  hash ^= hash >> 32;
  return static_cast<double>(hash & 0xFFFF) / 65535.0;
}

double smooth_noise(const Eigen::Vector2d& position) {
  const auto i = static_cast<std::int64_t>(std::floor(position.x()));
  const auto j = static_cast<std::int64_t>(std::floor(position.y()));
  const double u = position.x() - static_cast<double>(i);
  const double v = position.y() - static_cast<double>(j);
  const double s = u * u * (3.0 - 2.0 * u);
  const double t = v * v * (3.0 - 2.0 * v);
  const double low = lattice_value(i, j) * (1.0 - s) + lattice_value(i + 1, j) * s;
  const double high = lattice_value(i, j + 1) * (1.0 - s) + lattice_value(i + 1, j + 1) * s;
  return low * (1.0 - t) + high * t;
}

double texture(const Hit& hit) {
  const Eigen::Vector2d position = hit.texture + Eigen::Vector2d::Constant(50.0 * hit.label);
  const double coarse = smooth_noise(position / 0.45);
  const double fine = smooth_noise(position / 0.11);
  return 40.0 + 100.0 * coarse + 80.0 * fine;
}

/// Distance along the ray to the plane where coordinate `axis` is `value`; huge if behind.
double plane_distance(const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& ray,
                      int axis,
                      double value) {
  const double distance = (value - origin[axis]) / ray[axis];
  return distance > 0.0 && std::isfinite(distance) ? distance : 1e9;
}

Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  const double road = plane_distance(origin, ray, 2, 0.0);
  const double left = plane_distance(origin, ray, 1, kHalfWidthM);
  const double right = plane_distance(origin, ray, 1, -kHalfWidthM);
  const double end = plane_distance(origin, ray, 0, kEndM);
  const double nearest = std::min({road, left, right, end});
  const Eigen::Vector3d point = origin + nearest * ray;
  if (nearest == road) {
    return {{point.x(), point.y()}, kRoad};
  }
  if (nearest == end) {
    return {{point.y(), point.z()}, kBuilding};
  }
  return {{point.x() + (nearest == left ? 30.0 : 60.0), point.z()}, kBuilding};
}

template <typename Value>
cv::Mat draw(const Eigen::Isometry3d& map_from_camera, const Value& value) {
  const PinholeCamera camera = corridor_camera();
  cv::Mat image(camera.height, camera.width, CV_8UC1);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const Eigen::Vector3d ray = map_from_camera.linear() * camera.ray({column, row});
      image.at<std::uint8_t>(row, column) =
          cv::saturate_cast<std::uint8_t>(value(cast(map_from_camera.translation(), ray)));
    }
  }
  return image;
}

}  // namespace

Eigen::Isometry3d map_from_left(double x_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  // Columns: the camera's x (right), y (down) and z (forward) in the map (x forward, y left, z up).
  pose.linear() << 0, 0, 1,  //
      -1, 0, 0,              //
      0, -1, 0;
  pose.translation() = Eigen::Vector3d(x_m, 0.5 * kBaselineM, kCameraHeightM);
  return pose;
}

Eigen::Isometry3d map_from_right(double x_m) {
  Eigen::Isometry3d pose = map_from_left(x_m);
  pose.translation().y() -= kBaselineM;
  return pose;
}

PinholeCamera corridor_camera() {
  return {320, 200, 200.0, 200.0, 159.5, 99.5};
}

double distance_to_corridor(const Eigen::Vector3d& point) {
  return std::min({std::abs(point.z()),
                   std::abs(std::abs(point.y()) - kHalfWidthM),
                   std::abs(point.x() - kEndM)});
}

cv::Mat draw_gray(const Eigen::Isometry3d& map_from_camera) {
  return draw(map_from_camera, texture);
}

cv::Mat draw_labels(const Eigen::Isometry3d& map_from_camera) {
  return draw(map_from_camera, [](const Hit& hit) { return static_cast<int>(hit.label); });
}

}  // namespace facet_mapping::test
