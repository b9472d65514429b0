// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/chunked_mesh.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

/// A closed box whose faces are grids, spanning several chunks.
TriangleMesh box(double size_m, int steps) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> index;
  const auto vertex = [&](int x, int y, int z) {
    const auto [at, is_new] =
        index.try_emplace({x, y, z}, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.emplace_back(Eigen::Vector3d(x, y, z) * (size_m / steps));
    }
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 2 * steps * steps; ++k) {
      const int side = k % 2;
      const int a = k / 2 % steps;
      const int b = k / 2 / steps;
      const auto corner = [&](int u, int v) {
        std::array<int, 3> p{};
        p[axis] = side * steps;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return vertex(p[0], p[1], p[2]);
      };
      const std::array<std::uint32_t, 4> q{
          corner(a, b), corner(a + 1, b), corner(a + 1, b + 1), corner(a, b + 1)};
      const bool flip = side == 0;
      mesh.triangles.push_back(flip ? Triangle{q[0], q[2], q[1]} : Triangle{q[0], q[1], q[2]});
      mesh.triangles.push_back(flip ? Triangle{q[0], q[3], q[2]} : Triangle{q[0], q[2], q[3]});
      mesh.labels.insert(mesh.labels.end(), 2, static_cast<Label>(axis));
      mesh.confidence.insert(mesh.confidence.end(), 2, 0.5F);
    }
  }
  return mesh;
}

TriangleMesh assemble_all(const ChunkedMesh& chunked) {
  std::vector<const MeshChunk*> chunks;
  for (const auto& [key, chunk] : chunked.chunks()) {
    chunks.push_back(&chunk);
  }
  return assemble(chunks);
}

TEST(ChunkedMesh, ChunksWeldBackToTheSameMesh) {
  const TriangleMesh mesh = box(20.0, 8);
  ChunkedMesh chunked(8.0);
  const ChunkDelta delta = chunked.update(mesh);
  EXPECT_EQ(delta.changed.size(), chunked.chunks().size());
  EXPECT_GT(delta.changed.size(), 10U);
  const TriangleMesh welded = assemble_all(chunked);
  EXPECT_EQ(welded.vertices.size(), mesh.vertices.size());
  EXPECT_EQ(welded.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(welded.labels.size(), mesh.labels.size());
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold()) << check_manifold(mesh).to_string();
  EXPECT_TRUE(check_manifold(welded).is_closed_manifold());
}

TEST(ChunkedMesh, OnlyWhatChangedIsInTheDelta) {
  TriangleMesh mesh = box(20.0, 8);
  ChunkedMesh chunked(8.0);
  chunked.update(mesh);
  EXPECT_TRUE(chunked.update(mesh).changed.empty());
  mesh.labels[0] = 9;
  const ChunkDelta relabelled = chunked.update(mesh);
  ASSERT_EQ(relabelled.changed.size(), 1U);
  EXPECT_EQ(relabelled.changed[0].revision, 2U);
  EXPECT_TRUE(relabelled.removed.empty());
}

TEST(ChunkedMesh, VanishedChunksAreRemovedAndRevisionsStillGrow) {
  const TriangleMesh mesh = box(20.0, 8);
  ChunkedMesh chunked(8.0);
  const std::size_t count = chunked.update(mesh).changed.size();
  EXPECT_EQ(chunked.update(TriangleMesh{}).removed.size(), count);
  for (const MeshChunk& chunk : chunked.update(mesh).changed) {
    EXPECT_EQ(chunk.revision, 2U);
  }
}

TEST(ChunkedMesh, VertexIdsOutliveRenumbering) {
  const TriangleMesh mesh = box(4.0, 2);
  std::vector<std::uint32_t> ids(mesh.vertices.size());
  for (std::size_t v = 0; v < ids.size(); ++v) {
    ids[v] = static_cast<std::uint32_t>(1000 + v);
  }
  ChunkedMesh chunked(8.0);
  chunked.update(mesh, ids);
  EXPECT_GE(chunked.chunks().begin()->second.vertex_ids.front(), 1000U);
  ids.pop_back();
  EXPECT_THROW(chunked.update(mesh, ids), std::invalid_argument);
}

TEST(ChunkedMesh, BrokenChunksAreRefused) {
  ChunkedMesh chunked(8.0);
  chunked.update(box(4.0, 2));
  MeshChunk chunk = chunked.chunks().begin()->second;
  chunk.triangles[0][1] = 100000;
  EXPECT_THROW(assemble({&chunk}), std::invalid_argument);
  chunk = chunked.chunks().begin()->second;
  chunk.labels.pop_back();
  EXPECT_THROW(assemble({&chunk}), std::invalid_argument);
  EXPECT_THROW(ChunkedMesh(0.0), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
