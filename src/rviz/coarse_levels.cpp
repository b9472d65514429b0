// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "facet_mapping/rviz/chunk_geometry.h"

namespace facet_mapping {
namespace {

constexpr std::array<float, 2> kCells{0.25F, 1.0F};  // metres
constexpr std::size_t kFewIndices = 192;             // a chunk this small costs nothing

/// For each cell the vertex that stands for all in it: the nearest to its centre. Chunks usually
/// end where cells have their centres, so that neighbours choose the same vertices on the border.
class VertexGrid {
 public:
  explicit VertexGrid(float cell_m) : cell_m_(cell_m) {}

  void add(std::uint32_t vertex, const std::array<float, 3>& position) {
    std::int64_t key = 0;
    float off = 0.0F;
    for (const float value : position) {
      const float cell = std::round(value / cell_m_);
      key = key * kKeyStep + static_cast<std::int64_t>(cell);
      off += (value - cell * cell_m_) * (value - cell * cell_m_);
    }
    const auto [found, is_new] = nearest_.emplace(key, std::pair(off, vertex));
    if (!is_new && std::pair(off, vertex) < found->second) {
      found->second = {off, vertex};
    }
  }

  std::uint32_t at(const std::array<float, 3>& position) const {
    std::int64_t key = 0;
    for (const float value : position) {
      key = key * kKeyStep + static_cast<std::int64_t>(std::round(value / cell_m_));
    }
    return nearest_.at(key).second;
  }

 private:
  // Two far cells that shared a key would only look odd, and no chunk is that wide.
  static constexpr std::int64_t kKeyStep = 1 << 20;

  float cell_m_;
  std::unordered_map<std::int64_t, std::pair<float, std::uint32_t>> nearest_;
};

CoarseLevel make_level(float cell_m, ChunkGeometry* geometry) {
  VertexGrid grid(cell_m);
  for (const std::uint32_t vertex : geometry->indices) {
    grid.add(vertex, geometry->vertices[vertex].position);
  }
  CoarseLevel level;
  level.cell_m = cell_m;
  for (std::size_t k = 0; k < geometry->indices.size(); k += 3) {
    const std::uint32_t last = geometry->indices[k + 2];
    const std::uint32_t a = grid.at(geometry->vertices[geometry->indices[k]].position);
    const std::uint32_t b = grid.at(geometry->vertices[geometry->indices[k + 1]].position);
    const std::uint32_t c = grid.at(geometry->vertices[last].position);
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

void add_coarse_levels(ChunkGeometry* geometry) {
  std::size_t finer = geometry->indices.size();
  for (const float cell_m : kCells) {
    if (finer <= kFewIndices) {
      return;
    }
    const std::size_t vertices = geometry->vertices.size();
    CoarseLevel level = make_level(cell_m, geometry);
    if (level.indices.empty() || level.indices.size() > finer / 2) {
      geometry->vertices.resize(vertices);
      continue;
    }
    finer = level.indices.size();
    geometry->levels.push_back(std::move(level));
  }
}

}  // namespace facet_mapping
