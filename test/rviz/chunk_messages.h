// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chunks and meshes as messages, small enough to reason about.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <facet_mapping/LabeledMesh.h>

namespace facet_mapping {

/// Two facets of 0.5 square metres each in the plane z = 0, seen from above.
inline LabeledMeshChunk unit_square(std::int32_t key_x, std::uint32_t revision = 1) {
  LabeledMeshChunk chunk;
  chunk.key = {key_x, 0, 0};
  chunk.revision = revision;
  for (const auto& [x, y] : {std::pair(0.0F, 0.0F), {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
    geometry_msgs::Point32 vertex;
    vertex.x = x;
    vertex.y = y;
    chunk.vertices.push_back(vertex);
  }
  chunk.vertex_ids = {0, 1, 2, 3};
  chunk.triangles = {0, 1, 2, 0, 2, 3};
  chunk.labels = {5, 6};
  chunk.confidence = {100, 200};
  chunk.views = {3, 900};
  return chunk;
}

inline LabeledMesh mesh_message(std::uint32_t sequence,
                                bool full,
                                std::vector<LabeledMeshChunk> chunks,
                                const std::string& map_id = "map one") {
  LabeledMesh message;
  message.header.frame_id = "map";
  message.map_id = map_id;
  message.sequence = sequence;
  message.full = full ? 1 : 0;
  message.chunks = std::move(chunks);
  return message;
}

}  // namespace facet_mapping
