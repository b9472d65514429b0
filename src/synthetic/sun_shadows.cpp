// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sun_shadows.h"

#include <algorithm>
#include <cmath>

#include "street_selection.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

constexpr double kTile = 32.0;           // metres
constexpr double kPixel = 0.06;          // metres of a shadow map's pixel
constexpr double kSunDistance = 2000.0;  // metres from which a tile is looked at
constexpr double kBias = 0.06;           // metres, against surfaces shading themselves
constexpr double kMiddleHeight = 1.5;    // metres in the map, the middle of what receives shadows
constexpr double kReceivers = 6.5;       // metres above and below it that tiles cover

Eigen::Matrix3d map_from_sun(const Eigen::Vector3d& to_sun) {
  Eigen::Matrix3d axes;
  axes.col(2) = -to_sun;
  axes.col(0) = axes.col(2).cross(Eigen::Vector3d::UnitZ()).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// Half the side of the square that a tile's receivers fill as the sun sees them.
double half_extent() {
  return std::hypot(0.5 * std::sqrt(2.0) * kTile, kReceivers);
}

}  // namespace

SunShadows::Key SunShadows::key_at(const Eigen::Vector3d& point) {
  return {static_cast<int>(std::floor(point.x() / kTile)),
          static_cast<int>(std::floor(point.y() / kTile))};
}

SunShadows::Tile SunShadows::make_tile(const Street& street, const Key& key) {
  const Eigen::Vector3d center(
      (key.first + 0.5) * kTile, (key.second + 0.5) * kTile, kMiddleHeight);
  View sun;
  sun.world_from_cam.linear() = map_from_sun(street.to_sun);
  sun.world_from_cam.translation() = center + kSunDistance * street.to_sun;
  const int size = static_cast<int>(std::ceil(2.0 * half_extent() / kPixel));
  const double focal = kSunDistance / kPixel;
  sun.camera = {size, size, focal, focal, 0.5 * (size - 1), 0.5 * (size - 1)};
  const std::vector<std::size_t> parts = parts_in_view(street, sun, 2.0 * kSunDistance);
  return {sun.camera, sun.cam_from_world(), render_parts(street, parts, sun).depth};
}

SunShadows::SunShadows(const Street& street) {
  for (const StreetPart& part : street.parts) {
    for (std::uint32_t v = 0; v < part.vertex_count; ++v) {
      index_.emplace(key_at(street.mesh.vertices[part.first_vertex + v]), 0);
    }
  }
  std::vector<Key> keys;
  for (auto& [key, index] : index_) {
    index = keys.size();
    keys.push_back(key);
  }
  tiles_.resize(keys.size());
  tbb::parallel_for(
      std::size_t{0}, keys.size(), [&](std::size_t k) { tiles_[k] = make_tile(street, keys[k]); });
}

float SunShadows::sunlit(const Eigen::Vector3d& point, const Eigen::Vector3f& normal) const {
  const auto entry = index_.find(key_at(point));
  if (entry == index_.end()) {
    return 1.0F;
  }
  const Tile& tile = tiles_[entry->second];
  const Eigen::Vector3d in_sun = tile.sun_from_map * (point + kBias * normal.cast<double>().eval());
  const Eigen::Vector2d pixel = tile.camera.project(in_sun);
  const int x = static_cast<int>(std::floor(pixel.x()));
  const int y = static_cast<int>(std::floor(pixel.y()));
  if (x < 0 || y < 0 || x + 1 >= tile.depth.cols || y + 1 >= tile.depth.rows) {
    return 1.0F;
  }
  const auto lit = [&](int dx, int dy) {
    const float depth = tile.depth.at<float>(y + dy, x + dx);
    return depth == 0.0F || in_sun.z() - kBias < depth ? 1.0F : 0.0F;
  };
  const auto u = static_cast<float>(pixel.x() - x);
  const auto v = static_cast<float>(pixel.y() - y);
  const float upper = lit(0, 0) + u * (lit(1, 0) - lit(0, 0));
  const float lower = lit(0, 1) + u * (lit(1, 1) - lit(0, 1));
  return upper + v * (lower - upper);
}

}  // namespace facet_mapping
