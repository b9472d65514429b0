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

#include <facet_mapping/LabeledMesh.h>

#include "facet_mapping/mapping/chunked_mesh.h"

namespace facet_mapping {

/// Keeps messages' chunks as they came, bad ones included: make_chunk_geometry copes with those.
class ChunkStore {
 public:
  enum class Result {
    kApplied,  ///< the state is that of the message
    kOld,      ///< the message is older than the state; nothing was done
    kGap,      ///< a message before this one was missed: a full mesh is needed
  };

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
  bool has_mesh() const { return has_mesh_; }
  const std::string& frame_id() const { return frame_id_; }
  const std::string& map_id() const { return map_id_; }
  std::uint32_t sequence() const { return sequence_; }
  /// Forgets everything: all chunks are to be taken off the screen.
  void clear();

 private:
  Result judge(const LabeledMesh& message) const;
  void drop_all_but(const LabeledMesh& message);
  void remove(const ChunkKey& key);
  void replace(LabeledMeshChunk chunk, bool is_same_map);

  std::map<ChunkKey, LabeledMeshChunk> chunks_;
  std::set<ChunkKey> changed_;
  std::set<ChunkKey> removed_;
  bool has_mesh_ = false;
  std::string map_id_;
  std::string frame_id_;
  std::uint32_t sequence_ = 0;
};

}  // namespace facet_mapping
