// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

#include "facet_mapping/rviz/chunk_geometry.h"

namespace facet_mapping {
namespace {

constexpr std::array<float, 4> kCells{0.25F, 0.5F, 1.0F, 2.0F};  // metres
constexpr std::size_t kFewIndices = 192;                         // a chunk this small costs nothing
// Two far cells that shared a key would only look odd, and no chunk is that wide.
constexpr std::int64_t kKeyStep = 1 << 20;

struct Representative {
  std::uint32_t vertex = 0;
  bool is_inside = true;                                       // not on the chunk's border
  float squared_distance = std::numeric_limits<float>::max();  // from the cell's centre

  bool operator<(const Representative& other) const {
    return std::pair(is_inside, squared_distance) <
           std::pair(other.is_inside, other.squared_distance);
  }
};

/// For each vertex of the finest level the one that stands for all in its cell of a grid: the
/// nearest to the centre, of those on the border if there are any. Chunks side by side have these
/// in common, and so choose the same.
std::vector<std::uint32_t> representatives(const ChunkGeometry& geometry,
                                           const Eigen::Vector3d& origin,
                                           float cell_m) {
  const std::size_t count = geometry.on_border.size();
  const Eigen::Vector3d cells_to_origin = origin / static_cast<double>(cell_m);
  const Eigen::Vector3f shift =
      cell_m * (cells_to_origin.array() - cells_to_origin.array().round()).matrix().cast<float>();
  std::unordered_map<std::int64_t, std::uint32_t> cells;
  cells.reserve(count / 2);
  std::vector<Representative> chosen;
  std::vector<std::uint32_t> cell_of(count);
  std::vector<bool> is_done(count, false);
  for (const std::uint32_t vertex : geometry.indices) {
    if (is_done[vertex]) {
      continue;
    }
    is_done[vertex] = true;
    std::int64_t key = 0;
    float off = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float value =
          geometry.vertices[vertex].position[static_cast<std::size_t>(axis)] + shift[axis];
      const float cell = std::nearbyint(value / cell_m);
      key = key * kKeyStep + static_cast<std::int64_t>(cell);
      off += (value - cell * cell_m) * (value - cell * cell_m);
    }
    const auto [found, is_new] = cells.emplace(key, static_cast<std::uint32_t>(chosen.size()));
    if (is_new) {
      chosen.emplace_back();
    }
    cell_of[vertex] = found->second;
    const Representative candidate{vertex, !geometry.on_border[vertex], off};
    if (candidate < chosen[found->second]) {
      chosen[found->second] = candidate;
    }
  }
  for (std::size_t vertex = 0; vertex < count; ++vertex) {
    cell_of[vertex] = is_done[vertex] ? chosen[cell_of[vertex]].vertex : 0;
  }
  return cell_of;
}

CoarseLevel make_level(float cell_m, const Eigen::Vector3d& origin, ChunkGeometry* geometry) {
  const std::vector<std::uint32_t> moved = representatives(*geometry, origin, cell_m);
  CoarseLevel level;
  level.cell_m = cell_m;
  for (std::size_t k = 0; k < geometry->indices.size(); k += 3) {
    const std::uint32_t last = geometry->indices[k + 2];
    const std::uint32_t a = moved[geometry->indices[k]];
    const std::uint32_t b = moved[geometry->indices[k + 1]];
    const std::uint32_t c = moved[last];
    if (a == b || b == c || c == a) {
      continue;
    }
    FacetVertex own = geometry->vertices[last];
    own.position = geometry->vertices[c].position;
    level.indices.insert(level.indices.end(),
                         {a, b, static_cast<std::uint32_t>(geometry->vertices.size())});
    geometry->vertices.push_back(own);
  }
  return level;
}

}  // namespace

void add_coarse_levels(const Eigen::Vector3d& origin, ChunkGeometry* geometry) {
  std::size_t finer = geometry->indices.size();
  for (const float cell_m : kCells) {
    if (finer <= kFewIndices) {
      return;
    }
    const std::size_t vertices = geometry->vertices.size();
    CoarseLevel level = make_level(cell_m, origin, geometry);
    if (level.indices.empty() || level.indices.size() > finer / 2) {
      geometry->vertices.resize(vertices);
      continue;
    }
    finer = level.indices.size();
    geometry->levels.push_back(std::move(level));
  }
}

}  // namespace facet_mapping
