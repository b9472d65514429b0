// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Chunks that the freeze line leaves behind are final, and what is inside is as without a line.
#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string>

#include "support/street_drive.h"
#include <gtest/gtest.h>

#include "facet_mapping/mapping/chunk_archive.h"
#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/mapping/labeled_map.h"

namespace facet_mapping {
namespace {

constexpr double kChunkM = 4.0;

/// One horizontal triangle per cell of a row of chunks along x.
TriangleMesh row_of_triangles(int from, int to, double z = 1.0) {
  TriangleMesh mesh;
  for (int k = from; k < to; ++k) {
    const auto v = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(kChunkM * k + 1.0, 1.0, z);
    mesh.vertices.emplace_back(kChunkM * k + 2.0, 1.0, z);
    mesh.vertices.emplace_back(kChunkM * k + 1.0, 2.0, z);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  return mesh;
}

std::set<ChunkKey> keys_of(const std::vector<MeshChunk>& chunks) {
  std::set<ChunkKey> keys;
  for (const MeshChunk& chunk : chunks) {
    keys.insert(chunk.key);
  }
  return keys;
}

TEST(FreezeLine, CellsOnTheWayAreInside) {
  const FreezeLine a{{0.0, 0.0, 0.0}, 5.0};
  const FreezeLine b{{100.0, 0.0, 0.0}, 5.0};
  const auto cube = [](double x, double y) {
    return Eigen::AlignedBox3d(Eigen::Vector3d(x, y, 0.0), Eigen::Vector3d(x + 1.0, y + 1.0, 1.0));
  };
  EXPECT_FALSE(is_outside_between(a, b, cube(50.0, 4.9)));
  EXPECT_TRUE(is_outside_between(a, b, cube(50.0, 5.1)));
  EXPECT_TRUE(is_outside_between(a, b, cube(105.1, 0.0)));
  EXPECT_FALSE(is_outside_between(a, b, cube(-5.9, 0.0)));
  EXPECT_FALSE(is_outside_between({}, b, cube(500.0, 0.0)));
}

TEST(Freezing, OnlyCellsEntirelyOutsideFreeze) {
  ChunkedMesh chunked(kChunkM);
  const ChunkDelta delta = chunked.update(row_of_triangles(0, 10), {}, {{38.0, 2.0, 2.0}, 10.0});
  EXPECT_EQ(delta.changed.size(), 10U);
  EXPECT_EQ(delta.frozen.size(), 6U);  // the cell [24, 28] touches the ball, [20, 24] does not
  EXPECT_EQ(chunked.chunks().size(), 10U - delta.frozen.size());
}

TEST(Freezing, FrozenChunksNeitherChangeNorVanish) {
  ChunkedMesh chunked(kChunkM);
  const FreezeLine line{{38.0, 2.0, 2.0}, 10.0};
  const std::set<ChunkKey> frozen =
      keys_of(chunked.update(row_of_triangles(0, 10), {}, line).frozen);
  ASSERT_FALSE(frozen.empty());
  const ChunkDelta moved = chunked.update(row_of_triangles(0, 10, 1.5), {}, line);
  EXPECT_EQ(moved.changed.size(), 10U - frozen.size());
  EXPECT_TRUE(moved.frozen.empty());
  for (const MeshChunk& chunk : moved.changed) {
    EXPECT_EQ(frozen.count(chunk.key), 0U);
  }
  const ChunkDelta gone = chunked.update(TriangleMesh(), {}, line);
  EXPECT_EQ(gone.removed.size(), 10U - frozen.size());
  // Not even when the line comes back.
  const ChunkDelta back = chunked.update(row_of_triangles(0, 10, 1.7), {}, {{2.0, 2.0, 2.0}, 30.0});
  for (const MeshChunk& chunk : back.changed) {
    EXPECT_EQ(frozen.count(chunk.key), 0U);
  }
}

TEST(Freezing, EmptyCellsBehindTheLineStayEmptyUntilItComesBack) {
  ChunkedMesh chunked(kChunkM);
  const FreezeLine line{{38.0, 2.0, 2.0}, 10.0};
  chunked.update(row_of_triangles(8, 10), {}, line);
  const std::set<ChunkKey> kept =
      keys_of(chunked.update(row_of_triangles(0, 10), {}, line).changed);
  EXPECT_EQ(kept.count({6, 0, 0}), 1U);
  EXPECT_EQ(kept.count({5, 0, 0}), 0U);
  EXPECT_EQ(kept.count({0, 0, 0}), 0U);
  const ChunkDelta back = chunked.update(row_of_triangles(0, 10), {}, {{2.0, 2.0, 2.0}, 10.0});
  EXPECT_EQ(keys_of(back.changed).count({0, 0, 0}), 1U);
}

TEST(Freezing, WhatALongStepPassesIsKept) {
  ChunkedMesh chunked(kChunkM);
  chunked.update(row_of_triangles(0, 3), {}, {{2.0, 2.0, 2.0}, 10.0});
  const ChunkDelta far = chunked.update(row_of_triangles(0, 50), {}, {{198.0, 2.0, 2.0}, 10.0});
  EXPECT_EQ(far.changed.size(), 47U);
  EXPECT_EQ(keys_of(far.frozen).count({25, 0, 0}), 1U);
  chunked.clear();
  EXPECT_EQ(chunked.update(row_of_triangles(0, 50)).changed.size(), 50U);
}

/// A facet by its corners, whatever corner comes first.
using FacetKey = std::array<float, 9>;

/// The facets that were seen; those that only close the surface through space that nobody saw may
/// differ, since their shape hangs on what lies behind the line.
std::multiset<FacetKey> facets_of(const MeshChunk& chunk) {
  std::multiset<FacetKey> facets;
  for (std::size_t f = 0; f < chunk.triangles.size(); ++f) {
    if (chunk.views[f] == 0) {
      continue;
    }
    const Triangle& triangle = chunk.triangles[f];
    std::array<FacetKey, 3> turned;
    for (std::size_t turn = 0; turn < 3; ++turn) {
      for (std::size_t k = 0; k < 9; ++k) {
        turned.at(turn).at(k) =
            chunk.vertices[triangle.at((k / 3 + turn) % 3)][static_cast<Eigen::Index>(k % 3)];
      }
    }
    facets.insert(*std::min_element(turned.begin(), turned.end()));
  }
  return facets;
}

/// Facets that only one of them has.
std::size_t count_odd(const MeshChunk& a, const MeshChunk& b) {
  const std::multiset<FacetKey> mine = facets_of(a);
  const std::multiset<FacetKey> theirs = facets_of(b);
  std::vector<FacetKey> odd;
  std::set_symmetric_difference(
      mine.begin(), mine.end(), theirs.begin(), theirs.end(), std::back_inserter(odd));
  return odd.size();
}

MapConfig small_map() {
  MapConfig config;
  config.max_range_m = 12.0;
  config.carving.steiner_reach_m = 14.0;
  config.carving.steiner_spacing_m = 3.0;
  return config;
}

struct Driven {
  ChunkedMesh live{kChunkM};
  std::map<ChunkKey, MeshChunk> frozen;
  FreezeLine line;
  std::size_t updates_of_frozen = 0;
};

Driven drive_through(const std::vector<PointFrame>& drive, const MapConfig& config) {
  ClassInfo road;
  road.name = "road";
  road.color = {128, 64, 128};
  LabeledMap map(LabelSet({road}), config);
  Driven driven;
  for (const PointFrame& frame : drive) {
    map.add(frame);
    map.update();
    driven.line = map.freeze_line();
    ChunkDelta delta = driven.live.update(map.mesh(), map.surface().vertex_ids, driven.line);
    for (const MeshChunk& chunk : delta.changed) {
      driven.updates_of_frozen += driven.frozen.count(chunk.key);
    }
    for (MeshChunk& chunk : delta.frozen) {
      driven.frozen.emplace(chunk.key, std::move(chunk));
    }
  }
  return driven;
}

class FrozenDriveTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::vector<PointFrame> drive = testing_drive();
    MapConfig config = small_map();
    free_ = drive_through(drive, config);
    config.frozen_beyond_m = 20.0;
    bounded_ = drive_through(drive, config);
  }
  static std::vector<PointFrame> testing_drive() { return test::street_drive(44, 700, 12.0); }

  static inline Driven free_;
  static inline Driven bounded_;
};

TEST_F(FrozenDriveTest, InsideTheLineTheMeshIsThatOfAnUnboundedMap) {
  EXPECT_TRUE(free_.frozen.empty());
  EXPECT_GT(bounded_.frozen.size(), 10U);
  EXPECT_EQ(bounded_.updates_of_frozen, 0U);
  std::size_t compared = 0;
  for (const auto& [key, chunk] : free_.live.chunks()) {
    const Eigen::AlignedBox3d cell = cell_of(key, kChunkM);
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      farthest = std::max(
          farthest,
          (cell.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - bounded_.line.center)
              .norm());
    }
    if (farthest > bounded_.line.radius_m) {
      continue;
    }
    const auto same = bounded_.live.chunks().find(key);
    ASSERT_NE(same, bounded_.live.chunks().end());
    EXPECT_EQ(count_odd(chunk, same->second), 0U) << key[0] << " " << key[1] << " " << key[2];
    compared += chunk.triangles.size();
  }
  EXPECT_GT(compared, 5000U);
}

// Not quite all: the cut and the growth look at the whole map, so that a facet may turn over long
// after the last ray came near it.
TEST_F(FrozenDriveTest, FrozenChunksAreThoseOfAnUnboundedMap) {
  std::size_t facets = 0;
  std::size_t odd = 0;
  for (const auto& [key, chunk] : bounded_.frozen) {
    const auto same = free_.live.chunks().find(key);
    ASSERT_NE(same, free_.live.chunks().end());
    facets += facets_of(chunk).size();
    odd += count_odd(chunk, same->second);
  }
  EXPECT_GT(facets, 5000U);
  EXPECT_LE(odd, facets / 1000) << "of " << facets;
}

TEST_F(FrozenDriveTest, NothingIsMissingAndNothingDouble) {
  for (const auto& [key, chunk] : free_.live.chunks()) {
    const bool is_live = bounded_.live.chunks().count(key) > 0;
    const bool is_frozen = bounded_.frozen.count(key) > 0;
    EXPECT_NE(is_live, is_frozen) << key[0] << " " << key[1] << " " << key[2];
  }
}

}  // namespace
}  // namespace facet_mapping
