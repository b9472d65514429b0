// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which chunks of a mesh a display has, and the content of those that it has yet to draw anew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/ros/mesh_sequence.h"

namespace facet_mapping {

/// Hands each chunk out once: what is drawn lies on the graphics card and need not lie here, too.
/// Chunks are kept as they came, bad ones included: make_chunk_geometry copes with those.
class ChunkStore {
 public:
  using Result = MeshSequence::Result;

  /// Takes a message's chunks out of it, unless the result says that nothing was done. Those of a
  /// full mesh whose revision is known already count as unchanged, so that a full mesh after a gap
  /// draws only what was missed.
  Result apply(LabeledMesh&& message);

  /// The next chunk to draw anew, which is then no longer due; nothing if all are drawn.
  std::optional<LabeledMeshChunk> take_changed();
  /// A chunk that is gone and not yet taken off the screen.
  std::optional<ChunkKey> take_removed();
  std::size_t waiting() const { return due_.size(); }

  /// Number of chunks, drawn or not.
  std::size_t size() const { return revisions_.size(); }
  bool has_mesh() const { return state_.has_mesh(); }
  const std::string& frame_id() const { return state_.frame_id(); }
  const std::string& map_id() const { return state_.map_id(); }
  std::uint32_t sequence() const { return state_.sequence(); }
  /// Forgets everything: all chunks are to be taken off the screen.
  void clear();

 private:
  void drop_all_but(const LabeledMesh& message);
  void remove(const ChunkKey& key);
  void replace(LabeledMeshChunk chunk, bool is_same_map);

  std::map<ChunkKey, std::uint32_t> revisions_;  // of all chunks
  std::map<ChunkKey, LabeledMeshChunk> due_;
  std::set<ChunkKey> removed_;
  MeshSequence state_;
};

}  // namespace facet_mapping
