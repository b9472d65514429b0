// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh cut into chunks on a grid, so that only what changed needs to be sent.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

using ChunkKey = std::array<std::int32_t, 3>;

/// The facets whose centroid lies in one grid cell. Vertices on chunk borders stand in each chunk
/// that uses them; equal vertex ids mean the same vertex, so that chunks weld back exactly.
struct MeshChunk {
  ChunkKey key{};
  std::uint32_t revision = 0;                        ///< grows with every change of this chunk
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< corner of the grid cell, map frame, metres
  std::vector<Eigen::Vector3f> vertices;             ///< relative to the origin, metres
  std::vector<std::uint32_t> vertex_ids;             ///< one per vertex
  std::vector<Triangle> triangles;                   ///< indices into `vertices`
  std::vector<Label> labels;                         ///< per triangle, or empty
  std::vector<std::uint8_t> confidence;              ///< per triangle 0..255 = 0..1, or empty
  std::vector<std::uint16_t> views;                  ///< per triangle, or empty
};

struct ChunkDelta {
  std::vector<MeshChunk> changed;
  std::vector<ChunkKey> removed;
};

class ChunkedMesh {
 public:
  /// Throws std::invalid_argument unless `chunk_size_m` is positive.
  explicit ChunkedMesh(double chunk_size_m = 8.0);

  /// Takes a new state of the whole mesh and says which chunks differ from the last state.
  /// `vertex_ids`: one per vertex, or empty for 0, 1, 2, ...
  ChunkDelta update(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertex_ids = {});

  const std::map<ChunkKey, MeshChunk>& chunks() const { return chunks_; }
  void clear();

 private:
  double chunk_size_m_;
  std::map<ChunkKey, MeshChunk> chunks_;
  std::map<ChunkKey, std::uint32_t> last_revision_;
};

/// Welds chunks back into one mesh by vertex id.
/// Throws std::invalid_argument on indices out of range or attributes of wrong length.
TriangleMesh assemble(const std::vector<const MeshChunk*>& chunks);

}  // namespace facet_mapping
