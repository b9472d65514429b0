// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the geometry of chunks in threads of its own, so that the window's thread only uploads it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/rviz/chunk_geometry.h"
#include "facet_mapping/rviz/vertex_packing.h"

namespace facet_mapping {

struct BuiltChunk {
  ChunkKey key{};
  std::uint64_t ticket = 0;                          ///< as it was submitted
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< metres, in the mesh's frame
  /// With coarse levels, but without `vertices`; empty if the origin is no place.
  ChunkGeometry geometry;
  VertexPacking packing;
  std::vector<PackedVertex> vertices;
};

/// All functions are for one thread.
class ChunkBuilder {
 public:
  ChunkBuilder();
  /// Waits for the chunks that are being made, not for those that wait.
  ~ChunkBuilder();
  ChunkBuilder(const ChunkBuilder&) = delete;
  ChunkBuilder& operator=(const ChunkBuilder&) = delete;
  ChunkBuilder(ChunkBuilder&&) = delete;
  ChunkBuilder& operator=(ChunkBuilder&&) = delete;

  /// `slots`: of the chunk's labels.
  void submit(LabeledMeshChunk chunk, ClassSlots slots, std::uint64_t ticket);
  /// One that is ready, in no particular order.
  std::optional<BuiltChunk> take();
  /// Submitted and not yet taken.
  std::size_t under_way() const { return under_way_; }

 private:
  struct Job {
    LabeledMeshChunk chunk;
    ClassSlots slots;
    std::uint64_t ticket = 0;
  };

  void work();

  std::size_t under_way_ = 0;
  std::mutex mutex_;
  std::condition_variable is_news_;
  bool is_over_ = false;
  std::deque<Job> jobs_;
  std::deque<BuiltChunk> built_;
  std::vector<std::thread> threads_;
};

}  // namespace facet_mapping
