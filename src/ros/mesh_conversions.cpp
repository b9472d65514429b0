// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_conversions.h"

#include <algorithm>
#include <stdexcept>

namespace facet_mapping {
namespace {

std::string name_of(const LabeledMeshChunk& chunk) {
  return "mesh chunk (" + std::to_string(chunk.key[0]) + ", " + std::to_string(chunk.key[1]) +
         ", " + std::to_string(chunk.key[2]) + ")";
}

void check_lengths(const LabeledMeshChunk& chunk) {
  const std::size_t facets = chunk.triangles.size() / 3;
  const auto fits = [facets](std::size_t size) { return size == 0 || size == facets; };
  if (chunk.triangles.size() % 3 != 0 || chunk.vertex_ids.size() != chunk.vertices.size() ||
      !fits(chunk.labels.size()) || !fits(chunk.confidence.size()) || !fits(chunk.views.size())) {
    throw std::invalid_argument(name_of(chunk) +
                                ": the lengths of its arrays do not fit each other; see "
                                "`rosmsg show facet_mapping/LabeledMeshChunk`");
  }
  const std::size_t vertices = chunk.vertices.size();
  if (std::any_of(chunk.triangles.begin(), chunk.triangles.end(), [vertices](std::uint32_t v) {
        return v >= vertices;
      })) {
    throw std::invalid_argument(name_of(chunk) + ": a triangle names a vertex that is not there");
  }
}

}  // namespace

LabeledMeshChunk chunk_to_message(const MeshChunk& chunk) {
  LabeledMeshChunk message;
  std::copy(chunk.key.begin(), chunk.key.end(), message.key.begin());
  message.revision = chunk.revision;
  message.origin.x = chunk.origin.x();
  message.origin.y = chunk.origin.y();
  message.origin.z = chunk.origin.z();
  message.vertices.resize(chunk.vertices.size());
  for (std::size_t v = 0; v < chunk.vertices.size(); ++v) {
    message.vertices[v].x = chunk.vertices[v].x();
    message.vertices[v].y = chunk.vertices[v].y();
    message.vertices[v].z = chunk.vertices[v].z();
  }
  message.vertex_ids = chunk.vertex_ids;
  message.triangles.reserve(3 * chunk.triangles.size());
  for (const Triangle& triangle : chunk.triangles) {
    message.triangles.insert(message.triangles.end(), triangle.begin(), triangle.end());
  }
  message.labels = chunk.labels;
  message.confidence = chunk.confidence;
  message.views = chunk.views;
  return message;
}

MeshChunk chunk_from_message(const LabeledMeshChunk& message) {
  check_lengths(message);
  MeshChunk chunk;
  std::copy(message.key.begin(), message.key.end(), chunk.key.begin());
  chunk.revision = message.revision;
  chunk.origin = {message.origin.x, message.origin.y, message.origin.z};
  for (const geometry_msgs::Point32& v : message.vertices) {
    chunk.vertices.emplace_back(v.x, v.y, v.z);
  }
  chunk.vertex_ids = message.vertex_ids;
  for (std::size_t k = 0; k < message.triangles.size(); k += 3) {
    chunk.triangles.push_back(
        {message.triangles[k], message.triangles[k + 1], message.triangles[k + 2]});
  }
  chunk.labels = message.labels;
  chunk.confidence = message.confidence;
  chunk.views = message.views;
  return chunk;
}

TriangleMesh mesh_from_message(const LabeledMesh& message) {
  std::vector<MeshChunk> chunks;
  chunks.reserve(message.chunks.size());
  for (const LabeledMeshChunk& chunk : message.chunks) {
    chunks.push_back(chunk_from_message(chunk));
  }
  std::vector<const MeshChunk*> pointers;
  for (const MeshChunk& chunk : chunks) {
    pointers.push_back(&chunk);
  }
  return assemble(pointers);
}

ClassPalette palette_message(const LabelSet& labels,
                             const std::string& source,
                             std::uint32_t version) {
  ClassPalette palette;
  palette.version = version;
  palette.source = source;
  for (const ClassInfo& info : labels.classes()) {
    PaletteClass entry;
    entry.id = info.id;
    entry.name = info.name;
    entry.color.r = static_cast<float>(info.color[0]) / 255.0F;
    entry.color.g = static_cast<float>(info.color[1]) / 255.0F;
    entry.color.b = static_cast<float>(info.color[2]) / 255.0F;
    entry.color.a = 1.0F;
    entry.dynamic = info.dynamic ? 1 : 0;
    entry.ignore = info.ignore ? 1 : 0;
    entry.planar = info.planar ? 1 : 0;
    entry.sky = info.sky ? 1 : 0;
    palette.classes.push_back(entry);
  }
  return palette;
}

}  // namespace facet_mapping
