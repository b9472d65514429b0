// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which messages of a mesh topic follow each other.
#pragma once

#include <cstdint>
#include <string>

#include <facet_mapping/LabeledMesh.h>

namespace facet_mapping {

class MeshSequence {
 public:
  enum class Result {
    kApplied,  ///< the state is that of the message
    kOld,      ///< the message is older than the state; nothing was done
    kGap,      ///< a message before this one was missed: a full mesh is needed
  };

  /// What a receiver is to make of a message.
  Result judge(const LabeledMesh& message) const {
    const bool is_same_map = is_map(message.map_id);
    if (message.full != 0) {
      return is_same_map && message.sequence < sequence_ ? Result::kOld : Result::kApplied;
    }
    if (is_same_map && message.sequence <= sequence_) {
      return Result::kOld;
    }
    return is_same_map && message.sequence == sequence_ + 1 ? Result::kApplied : Result::kGap;
  }

  /// The state is that of the message now.
  void advance_to(const LabeledMesh& message) {
    has_mesh_ = true;
    map_id_ = message.map_id;
    frame_id_ = message.header.frame_id;
    sequence_ = message.sequence;
  }

  /// True once there is a mesh, if it is of this map.
  bool is_map(const std::string& map_id) const { return has_mesh_ && map_id == map_id_; }
  bool has_mesh() const { return has_mesh_; }
  const std::string& map_id() const { return map_id_; }
  const std::string& frame_id() const { return frame_id_; }
  std::uint32_t sequence() const { return sequence_; }

 private:
  bool has_mesh_ = false;
  std::string map_id_;
  std::string frame_id_;
  std::uint32_t sequence_ = 0;
};

}  // namespace facet_mapping
