// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The other end of ~mesh: keeps the chunks and notices what was missed.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/ros/mesh_sequence.h"

namespace facet_mapping {

class MeshReceiver {
 public:
  using Result = MeshSequence::Result;

  /// Applies a message. Throws std::invalid_argument if it contradicts itself; the state is then
  /// that before it.
  Result apply(const LabeledMesh& message);

  bool has_mesh() const { return state_.has_mesh(); }
  const std::string& map_id() const { return state_.map_id(); }
  const std::string& frame_id() const { return state_.frame_id(); }
  std::uint32_t sequence() const { return state_.sequence(); }
  const ros::Time& stamp() const { return stamp_; }

  /// Welds the chunks into one mesh.
  TriangleMesh mesh() const;
  void clear();

 private:
  std::map<ChunkKey, MeshChunk> chunks_;
  MeshSequence state_;
  ros::Time stamp_;
};

}  // namespace facet_mapping
