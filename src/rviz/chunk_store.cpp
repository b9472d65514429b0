// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/chunk_store.h"

#include <algorithm>
#include <utility>

#include "facet_mapping/rviz/chunk_geometry.h"

namespace facet_mapping {
ChunkStore::Result ChunkStore::apply(LabeledMesh&& message) {
  const Result result = state_.judge(message);
  if (result != Result::kApplied) {
    return result;
  }
  const bool is_same_map = state_.is_map(message.map_id) && !message.map_id.empty();
  if (message.full != 0) {
    drop_all_but(message);
  }
  for (std::size_t k = 0; k + 2 < message.removed_keys.size(); k += 3) {
    remove({message.removed_keys[k], message.removed_keys[k + 1], message.removed_keys[k + 2]});
  }
  for (LabeledMeshChunk& chunk : message.chunks) {
    replace(std::move(chunk), is_same_map);
  }
  state_.advance_to(message);
  return result;
}

void ChunkStore::drop_all_but(const LabeledMesh& message) {
  std::set<ChunkKey> kept;
  for (const LabeledMeshChunk& chunk : message.chunks) {
    kept.insert(key_of(chunk));
  }
  for (auto next = revisions_.begin(); next != revisions_.end();) {
    const ChunkKey key = (next++)->first;
    if (kept.count(key) == 0) {
      remove(key);
    }
  }
}

void ChunkStore::remove(const ChunkKey& key) {
  if (revisions_.erase(key) > 0) {
    removed_.insert(key);
  }
  due_.erase(key);
}

void ChunkStore::replace(LabeledMeshChunk chunk, bool is_same_map) {
  const ChunkKey key = key_of(chunk);
  const auto known = revisions_.find(key);
  if (is_same_map && known != revisions_.end() && known->second == chunk.revision) {
    return;
  }
  if (is_same_map) {
    removed_.erase(key);
  } else if (known != revisions_.end()) {
    removed_.insert(key);  // the old one must leave, late as the new one may be
  }
  revisions_[key] = chunk.revision;
  due_[key] = std::move(chunk);
}

std::optional<LabeledMeshChunk> ChunkStore::take_changed() {
  if (due_.empty()) {
    return std::nullopt;
  }
  LabeledMeshChunk chunk = std::move(due_.begin()->second);
  due_.erase(due_.begin());
  return chunk;
}

std::optional<ChunkKey> ChunkStore::take_removed() {
  if (removed_.empty()) {
    return std::nullopt;
  }
  const ChunkKey key = *removed_.begin();
  removed_.erase(removed_.begin());
  return key;
}

void ChunkStore::clear() {
  std::set<ChunkKey> removed = std::move(removed_);
  for (const auto& [key, revision] : revisions_) {
    removed.insert(key);
  }
  *this = ChunkStore();
  removed_ = std::move(removed);
}

}  // namespace facet_mapping
