// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The chunks of a mesh as a display holds them, and which of them it has yet to draw anew.
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

/// Keeps messages' chunks as they came, bad ones included: make_chunk_geometry copes with those.
class ChunkStore {
 public:
  using Result = MeshSequence::Result;

  /// Takes a message's chunks out of it, unless the result says that nothing was done. Those of a
  /// full mesh whose revision is known already count as unchanged, so that a full mesh after a gap
  /// draws only what was missed.
  Result apply(LabeledMesh&& message);

  /// The next chunk to draw anew, which is then no longer due; nothing if all are drawn.
  const LabeledMeshChunk* take_changed();
  /// A chunk that is gone and not yet taken off the screen.
  std::optional<ChunkKey> take_removed();
  std::size_t waiting() const { return changed_.size(); }

  const std::map<ChunkKey, LabeledMeshChunk>& chunks() const { return chunks_; }
  std::size_t facets() const;
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

  std::map<ChunkKey, LabeledMeshChunk> chunks_;
  std::set<ChunkKey> changed_;
  std::set<ChunkKey> removed_;
  MeshSequence state_;
};

}  // namespace facet_mapping
