// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_receiver.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "facet_mapping/ros/mesh_conversions.h"

namespace facet_mapping {

MeshReceiver::Result MeshReceiver::apply(const LabeledMesh& message) {
  const Result result = state_.judge(message);
  if (result != Result::kApplied) {
    return result;
  }
  if (message.removed_keys.size() % 3 != 0) {
    throw std::invalid_argument("mesh: the length of removed_keys is no multiple of 3");
  }
  std::vector<MeshChunk> changed;
  for (const LabeledMeshChunk& chunk : message.chunks) {
    changed.push_back(chunk_from_message(chunk));
  }
  if (message.full != 0) {
    chunks_.clear();
  }
  for (std::size_t k = 0; k < message.removed_keys.size(); k += 3) {
    chunks_.erase(
        {message.removed_keys[k], message.removed_keys[k + 1], message.removed_keys[k + 2]});
  }
  for (MeshChunk& chunk : changed) {
    const ChunkKey key = chunk.key;
    chunks_[key] = std::move(chunk);
  }
  state_.advance_to(message);
  stamp_ = message.header.stamp;
  return result;
}

TriangleMesh MeshReceiver::mesh() const {
  std::vector<const MeshChunk*> pointers;
  for (const auto& [key, chunk] : chunks_) {
    pointers.push_back(&chunk);
  }
  return assemble(pointers);
}

void MeshReceiver::clear() {
  *this = MeshReceiver();
}

}  // namespace facet_mapping
