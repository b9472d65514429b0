// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The other end of ~mesh: keeps the chunks and notices what was missed.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include <facet_mapping/LabeledMesh.h>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/mapping/chunked_mesh.h"

namespace facet_mapping {

class MeshReceiver {
 public:
  enum class Result {
    kApplied,  ///< the state is that of the message
    kOld,      ///< the message is older than the state; nothing was done
    kGap,      ///< a message before this one was missed: a full mesh is needed
  };

  /// Applies a message. Throws std::invalid_argument if it contradicts itself; the state is then
  /// that before it.
  Result apply(const LabeledMesh& message);

  bool has_mesh() const { return has_mesh_; }
  const std::string& map_id() const { return map_id_; }
  const std::string& frame_id() const { return frame_id_; }
  std::uint32_t sequence() const { return sequence_; }
  const ros::Time& stamp() const { return stamp_; }

  /// Welds the chunks into one mesh.
  TriangleMesh mesh() const;
  void clear();

 private:
  bool is_next(const LabeledMesh& message) const;

  std::map<ChunkKey, MeshChunk> chunks_;
  bool has_mesh_ = false;
  std::string map_id_;
  std::string frame_id_;
  std::uint32_t sequence_ = 0;
  ros::Time stamp_;
};

}  // namespace facet_mapping
