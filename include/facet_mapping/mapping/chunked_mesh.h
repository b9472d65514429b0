// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh cut into chunks on a grid, so that only what changed needs to be sent.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/mapping/freeze_line.h"

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

  std::size_t bytes() const;  ///< of memory held
};

bool operator==(const MeshChunk& a, const MeshChunk& b);

/// The grid cell of a chunk, map frame, metres.
Eigen::AlignedBox3d cell_of(const ChunkKey& key, double chunk_size_m);

struct ChunkDelta {
  std::vector<MeshChunk> changed;
  std::vector<ChunkKey> removed;
  /// Chunks that are final and not kept any more: their new owner keeps them. Those that changed at
  /// the last moment stand in `changed`, too.
  std::vector<MeshChunk> frozen;
};

class ChunkedMesh {
 public:
  /// Throws std::invalid_argument unless `chunk_size_m` is positive.
  explicit ChunkedMesh(double chunk_size_m = 8.0);

  /// Takes a new state of the whole mesh and says which chunks differ from the last state.
  /// `vertex_ids`: one per vertex, or empty for 0, 1, 2, ...
  /// Chunks whose cells lie entirely outside `line` freeze: later updates neither change nor remove
  /// them. Where the line has left an empty cell behind, facets of later states are ignored until
  /// the line comes back, since the surface there is only that of forgotten evidence.
  ChunkDelta update(const TriangleMesh& mesh,
                    const std::vector<std::uint32_t>& vertex_ids = {},
                    const FreezeLine& line = {});

  /// The chunks that can still change.
  const std::map<ChunkKey, MeshChunk>& chunks() const { return chunks_; }
  /// The chunks that cannot.
  const std::set<ChunkKey>& frozen() const { return frozen_; }
  double chunk_size_m() const { return chunk_size_m_; }
  std::size_t bytes() const;  ///< of memory held
  void clear();

 private:
  bool is_final(const ChunkKey& key, const FreezeLine& line) const;
  std::vector<MeshChunk> freeze(const FreezeLine& line);

  double chunk_size_m_;
  FreezeLine line_;
  std::map<ChunkKey, MeshChunk> chunks_;
  std::set<ChunkKey> frozen_;
  std::map<ChunkKey, std::uint32_t> last_revision_;
};

/// Welds chunks back into one mesh by vertex id.
/// Throws std::invalid_argument on indices out of range or attributes of wrong length.
TriangleMesh assemble(const std::vector<const MeshChunk*>& chunks);

}  // namespace facet_mapping
