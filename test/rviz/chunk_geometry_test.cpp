// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/chunk_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "chunk_messages.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A wavy field of 2 * cells^2 facets, each with a class of its own.
LabeledMeshChunk wavy_field(std::uint32_t cells) {
  LabeledMeshChunk chunk;
  for (std::uint32_t row = 0; row <= cells; ++row) {
    for (std::uint32_t column = 0; column <= cells; ++column) {
      geometry_msgs::Point32 v;
      v.x = static_cast<float>(column);
      v.y = static_cast<float>(row);
      v.z = static_cast<float>((row * 7 + column * 3) % 5) * 0.3F;
      chunk.vertices.push_back(v);
    }
  }
  for (std::uint32_t row = 0; row < cells; ++row) {
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t a = row * (cells + 1) + column;
      const std::uint32_t b = a + cells + 1;
      chunk.triangles.insert(chunk.triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
  for (std::size_t facet = 0; facet < chunk.triangles.size() / 3; ++facet) {
    chunk.labels.push_back(static_cast<Label>(facet % 200));
  }
  return chunk;
}

ChunkGeometry geometry_of(const LabeledMeshChunk& chunk, ClassTable* classes) {
  return make_chunk_geometry(chunk, classes->slots_of(chunk.labels));
}

std::array<float, 3> given_point(const LabeledMeshChunk& chunk, std::size_t corner) {
  const geometry_msgs::Point32& v = chunk.vertices[chunk.triangles[corner]];
  return {v.x, v.y, v.z};
}

TEST(ChunkGeometry, EveryFacetKeepsItsCornersTurnSenseAndAttributes) {
  const LabeledMeshChunk chunk = wavy_field(12);
  ClassTable classes;
  const ChunkGeometry geometry = geometry_of(chunk, &classes);
  ASSERT_EQ(geometry.indices.size(), chunk.triangles.size());
  std::set<std::uint32_t> last_corners;
  for (std::size_t k = 0; k < chunk.triangles.size(); k += 3) {
    std::array<std::array<float, 3>, 3> drawn{};
    std::array<std::array<float, 3>, 3> given{};
    for (std::size_t c = 0; c < 3; ++c) {
      drawn[c] = geometry.vertices[geometry.indices[k + c]].position;
      given[c] = given_point(chunk, k + c);
    }
    int turns = 0;
    while (drawn != given && turns++ < 3) {
      std::rotate(drawn.begin(), drawn.begin() + 1, drawn.end());
    }
    EXPECT_EQ(drawn, given) << "facet " << k / 3;
    const std::uint32_t last = geometry.indices[k + 2];
    EXPECT_TRUE(last_corners.insert(last).second) << "two facets share their last corner";
    EXPECT_EQ(geometry.vertices[last].facet[0], classes.slot_of(chunk.labels[k / 3]));
  }
}

TEST(ChunkGeometry, NeedsAboutOneVertexPerFacet) {
  const LabeledMeshChunk chunk = wavy_field(40);
  ClassTable classes;
  const ChunkGeometry geometry = geometry_of(chunk, &classes);
  EXPECT_LT(geometry.vertices.size(), geometry.indices.size() / 3 * 11 / 10);
}

TEST(ChunkGeometry, CarriesAttributesNormalsAndAreas) {
  ClassTable classes;
  const ChunkGeometry geometry = geometry_of(unit_square(0), &classes);
  ASSERT_EQ(geometry.indices.size(), 6U);
  const FacetVertex& first = geometry.vertices[geometry.indices[2]];
  const FacetVertex& second = geometry.vertices[geometry.indices[5]];
  EXPECT_EQ(first.normal[2], 127);
  EXPECT_EQ(first.normal[0], 0);
  EXPECT_EQ(first.facet[1], 100);
  EXPECT_EQ(first.facet[2], 3);
  EXPECT_EQ(second.facet[2], 255);
  EXPECT_DOUBLE_EQ(geometry.area_by_slot_m2.at(classes.slot_of(5)), 0.5);
  EXPECT_DOUBLE_EQ(geometry.area_by_slot_m2.at(classes.slot_of(6)), 0.5);
  EXPECT_TRUE(geometry.box.isApprox(
      Eigen::AlignedBox3f(Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 1, 0))));
}

TEST(ChunkGeometry, LeavesOutFacetsThatNobodyCanDraw) {
  LabeledMeshChunk chunk = unit_square(0);
  chunk.vertices[3].z = kNan;
  ClassTable classes;
  ChunkGeometry geometry = geometry_of(chunk, &classes);
  EXPECT_EQ(geometry.indices.size(), 3U);
  EXPECT_EQ(geometry.bad_facets, 1U);
  chunk.triangles = {0, 1, 4, 0, 1, 4000000000U};
  geometry = geometry_of(chunk, &classes);
  EXPECT_TRUE(geometry.indices.empty());
  EXPECT_EQ(geometry.bad_facets, 2U);
  EXPECT_TRUE(geometry.box.isEmpty());
  chunk = unit_square(0);
  chunk.vertices[0].x = 1.0e30F;
  EXPECT_EQ(geometry_of(chunk, &classes).bad_facets, 2U);
}

TEST(ChunkGeometry, TakesArraysOfWrongLengthAsAbsent) {
  LabeledMeshChunk chunk = unit_square(0);
  chunk.labels.push_back(1);
  chunk.confidence.pop_back();
  chunk.views.clear();
  ClassTable classes;
  const ChunkGeometry geometry = geometry_of(chunk, &classes);
  EXPECT_TRUE(geometry.bad_attributes);
  const std::array<std::uint8_t, 4> facet = geometry.vertices[geometry.indices[2]].facet;
  EXPECT_EQ(facet[0], 0);
  EXPECT_EQ(facet[1], 255);
  EXPECT_EQ(facet[2], 1);  // taken for seen
}

TEST(ChunkGeometry, AbsentArraysAreNoFault) {
  LabeledMeshChunk chunk = unit_square(0);
  chunk.labels.clear();
  chunk.confidence.clear();
  chunk.views.clear();
  ClassTable classes;
  EXPECT_FALSE(geometry_of(chunk, &classes).bad_attributes);
}

TEST(ChunkGeometry, AFacetWithoutAreaHasNoNormal) {
  LabeledMeshChunk chunk = unit_square(0);
  chunk.triangles = {0, 0, 1};
  chunk.labels = {1};
  ClassTable classes;
  const ChunkGeometry geometry = geometry_of(chunk, &classes);
  ASSERT_EQ(geometry.indices.size(), 3U);
  EXPECT_EQ(geometry.vertices[geometry.indices[2]].normal, (std::array<std::int8_t, 4>{}));
}

TEST(ChunkGeometry, AnEmptyChunkIsEmpty) {
  ClassTable classes;
  const ChunkGeometry geometry = geometry_of(LabeledMeshChunk(), &classes);
  EXPECT_TRUE(geometry.vertices.empty());
  EXPECT_EQ(geometry.bad_facets, 0U);
}

TEST(CoarseLevels, MoveNothingFartherThanTheirCellAndKeepClasses) {
  LabeledMeshChunk chunk = wavy_field(40);
  for (geometry_msgs::Point32& v : chunk.vertices) {  // 4 m of ground, vertices 10 cm apart
    v.x *= 0.1F;
    v.y *= 0.1F;
    v.z *= 0.1F;
  }
  ClassTable classes;
  ChunkGeometry geometry = geometry_of(chunk, &classes);
  const std::size_t fine_vertices = geometry.vertices.size();
  const std::vector<std::uint32_t> fine_indices = geometry.indices;
  add_coarse_levels(Eigen::Vector3d::Zero(), &geometry);
  EXPECT_EQ(geometry.indices, fine_indices);
  ASSERT_GE(geometry.levels.size(), 2U);
  EXPECT_LT(geometry.vertices.size(), 2 * fine_vertices);
  std::size_t finer = fine_indices.size();
  for (const CoarseLevel& level : geometry.levels) {
    EXPECT_LE(level.indices.size(), finer / 2);
    finer = level.indices.size();
    Eigen::AlignedBox3f box;
    std::set<std::uint32_t> last_corners;
    for (std::size_t k = 0; k < level.indices.size(); ++k) {
      ASSERT_LT(level.indices[k], geometry.vertices.size());
      box.extend(Eigen::Vector3f::Map(geometry.vertices[level.indices[k]].position.data()));
      if (k % 3 == 2) {
        EXPECT_TRUE(last_corners.insert(level.indices[k]).second);
        EXPECT_NE(geometry.vertices[level.indices[k]].normal[2], 0);
      }
    }
    EXPECT_LE((box.min() - geometry.box.min()).cwiseAbs().maxCoeff(), level.cell_m);
    EXPECT_LE((box.max() - geometry.box.max()).cwiseAbs().maxCoeff(), level.cell_m);
  }
}

/// Positions of the corners of edges that only one facet has.
std::multiset<std::array<double, 3>> border_of(const ChunkGeometry& geometry,
                                               const std::vector<std::uint32_t>& indices,
                                               const Eigen::Vector3d& origin) {
  using Place = std::array<double, 3>;
  std::map<std::pair<Place, Place>, int> edges;
  const auto place = [&](std::uint32_t vertex) {
    const std::array<float, 3>& p = geometry.vertices[vertex].position;
    return Place{origin.x() + p[0], origin.y() + p[1], origin.z() + p[2]};
  };
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const Place a = place(indices[k]);
    const Place b = place(indices[k % 3 == 2 ? k - 2 : k + 1]);
    ++edges[std::minmax(a, b)];
  }
  std::multiset<Place> border;
  for (const auto& [edge, count] : edges) {
    if (count == 1) {
      border.insert(edge.first);
      border.insert(edge.second);
    }
  }
  return border;
}

/// One wavy field of 4 m, cut along a jagged line into two chunks whose origins are no whole cells
/// apart.
std::array<LabeledMeshChunk, 2> torn_field() {
  const LabeledMeshChunk field = wavy_field(40);
  std::array<LabeledMeshChunk, 2> halves;
  halves[1].origin.x = 1.9;
  for (std::size_t k = 0; k < field.triangles.size(); ++k) {
    const std::uint32_t column = field.triangles[k - k % 3] % 41;
    LabeledMeshChunk& half = halves[column >= 21 + (k / 3) % 2 ? 1 : 0];
    geometry_msgs::Point32 v = field.vertices[field.triangles[k]];
    v.x = 0.1F * v.x - static_cast<float>(half.origin.x);
    v.y *= 0.1F;
    v.z *= 0.1F;
    const auto is_same = [&v](const geometry_msgs::Point32& other) {
      return other.x == v.x && other.y == v.y;
    };
    const auto known = std::find_if(half.vertices.begin(), half.vertices.end(), is_same);
    half.triangles.push_back(static_cast<std::uint32_t>(known - half.vertices.begin()));
    if (known == half.vertices.end()) {
      half.vertices.push_back(v);
    }
  }
  return halves;
}

TEST(CoarseLevels, ChunksSideBySideStayJoined) {
  const std::array<LabeledMeshChunk, 2> halves = torn_field();
  ClassTable classes;
  std::array<std::vector<std::set<std::pair<int, int>>>, 2> seams;  // millimetres, by level
  for (std::size_t side = 0; side < 2; ++side) {
    const Eigen::Vector3d origin(halves[side].origin.x, 0.0, 0.0);
    ChunkGeometry geometry = geometry_of(halves[side], &classes);
    add_coarse_levels(origin, &geometry);
    ASSERT_GE(geometry.levels.size(), 2U);
    for (std::size_t level = 0; level < 2; ++level) {
      seams[side].emplace_back();
      for (const auto& p : border_of(geometry, geometry.levels[level].indices, origin)) {
        if (p[0] > 1.0 && p[0] < 3.0 && p[1] > 0.6 && p[1] < 3.4) {
          seams[side].back().emplace(std::lround(1000.0 * p[0]), std::lround(1000.0 * p[1]));
        }
      }
      EXPECT_FALSE(seams[side].back().empty());
    }
  }
  EXPECT_EQ(seams[0], seams[1]);
}

TEST(CoarseLevels, AreLeftOutWhereTheyGainNothing) {
  ClassTable classes;
  ChunkGeometry geometry = geometry_of(unit_square(0), &classes);
  add_coarse_levels(Eigen::Vector3d::Zero(), &geometry);
  EXPECT_TRUE(geometry.levels.empty());
  ChunkGeometry empty;
  add_coarse_levels(Eigen::Vector3d::Zero(), &empty);
  EXPECT_TRUE(empty.levels.empty());
}

TEST(ChunkGeometry, UnknownClassesAreMetOnceEach) {
  ClassTable classes;
  LabeledMeshChunk chunk = unit_square(0);
  chunk.labels = {60000, 60000};
  geometry_of(chunk, &classes);
  EXPECT_EQ(classes.styles().size(), 2U);
}

}  // namespace
}  // namespace facet_mapping
