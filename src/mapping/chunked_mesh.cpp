// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/chunked_mesh.h"

#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace facet_mapping {
namespace {

ChunkKey key_of(const Eigen::Vector3d& point, double size_m) {
  return {static_cast<std::int32_t>(std::floor(point.x() / size_m)),
          static_cast<std::int32_t>(std::floor(point.y() / size_m)),
          static_cast<std::int32_t>(std::floor(point.z() / size_m))};
}

/// A chunk being filled, with the index of each mesh vertex in it.
struct Draft {
  MeshChunk chunk;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of_vertex;
};

class ChunkCutter {
 public:
  ChunkCutter(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids, double size_m)
      : mesh_(mesh), ids_(ids), size_m_(size_m) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      add_facet(f);
    }
  }

  std::map<ChunkKey, MeshChunk> take() {
    std::map<ChunkKey, MeshChunk> chunks;
    for (auto& [key, draft] : drafts_) {
      chunks.emplace(key, std::move(draft.chunk));
    }
    return chunks;
  }

 private:
  void add_facet(std::size_t facet) {
    const Triangle& triangle = mesh_.triangles[facet];
    const Eigen::Vector3d centroid =
        (mesh_.vertices[triangle[0]] + mesh_.vertices[triangle[1]] + mesh_.vertices[triangle[2]]) /
        3.0;
    const ChunkKey key = key_of(centroid, size_m_);
    Draft& draft = drafts_[key];
    draft.chunk.key = key;
    draft.chunk.origin = size_m_ * Eigen::Vector3d(key[0], key[1], key[2]);
    draft.chunk.triangles.push_back({local_index(&draft, triangle[0]),
                                     local_index(&draft, triangle[1]),
                                     local_index(&draft, triangle[2])});
    if (!mesh_.labels.empty()) {
      draft.chunk.labels.push_back(mesh_.labels[facet]);
    }
    if (!mesh_.confidence.empty()) {
      draft.chunk.confidence.push_back(
          static_cast<std::uint8_t>(std::lround(255.0F * mesh_.confidence[facet])));
    }
    if (!mesh_.views.empty()) {
      draft.chunk.views.push_back(mesh_.views[facet]);
    }
  }

  std::uint32_t local_index(Draft* draft, std::uint32_t vertex) const {
    const auto [at, is_new] = draft->index_of_vertex.try_emplace(
        vertex, static_cast<std::uint32_t>(draft->chunk.vertices.size()));
    if (is_new) {
      const Eigen::Vector3d local = mesh_.vertices[vertex] - draft->chunk.origin;
      draft->chunk.vertices.emplace_back(local.cast<float>());
      draft->chunk.vertex_ids.push_back(ids_.empty() ? vertex : ids_[vertex]);
    }
    return at->second;
  }

  const TriangleMesh& mesh_;
  const std::vector<std::uint32_t>& ids_;
  double size_m_;
  std::map<ChunkKey, Draft> drafts_;
};

bool same_content(const MeshChunk& a, const MeshChunk& b) {
  return a.vertices == b.vertices && a.vertex_ids == b.vertex_ids && a.triangles == b.triangles &&
         a.labels == b.labels && a.confidence == b.confidence && a.views == b.views;
}

void check_length(std::size_t size, std::size_t facets, const char* name) {
  if (size != 0 && size != facets) {
    throw std::invalid_argument("mesh chunk: " + std::to_string(size) + " " + name + " for " +
                                std::to_string(facets) + " triangles");
  }
}

void check_chunk(const MeshChunk& chunk) {
  if (chunk.vertex_ids.size() != chunk.vertices.size()) {
    throw std::invalid_argument("mesh chunk: vertex_ids and vertices differ in length");
  }
  check_length(chunk.labels.size(), chunk.triangles.size(), "labels");
  check_length(chunk.confidence.size(), chunk.triangles.size(), "confidences");
  check_length(chunk.views.size(), chunk.triangles.size(), "view counts");
  for (const Triangle& triangle : chunk.triangles) {
    for (const std::uint32_t v : triangle) {
      if (v >= chunk.vertices.size()) {
        throw std::invalid_argument("mesh chunk: a triangle names vertex " + std::to_string(v) +
                                    " of only " + std::to_string(chunk.vertices.size()));
      }
    }
  }
}

}  // namespace

std::size_t MeshChunk::bytes() const {
  return sizeof(MeshChunk) + bytes_of(vertices) + bytes_of(vertex_ids) + bytes_of(triangles) +
         bytes_of(labels) + bytes_of(confidence) + bytes_of(views);
}

bool operator==(const MeshChunk& a, const MeshChunk& b) {
  return a.key == b.key && a.revision == b.revision && a.origin == b.origin && same_content(a, b);
}

Eigen::AlignedBox3d cell_of(const ChunkKey& key, double chunk_size_m) {
  const Eigen::Vector3d corner(key[0], key[1], key[2]);
  return {chunk_size_m * corner, chunk_size_m * (corner + Eigen::Vector3d::Ones())};
}

ChunkedMesh::ChunkedMesh(double chunk_size_m) : chunk_size_m_(chunk_size_m) {
  if (!(chunk_size_m > 0.0)) {
    throw std::invalid_argument("chunked mesh: chunk_size_m must be positive");
  }
}

ChunkDelta ChunkedMesh::update(const TriangleMesh& mesh,
                               const std::vector<std::uint32_t>& vertex_ids,
                               const FreezeLine& line) {
  if (!vertex_ids.empty() && vertex_ids.size() != mesh.vertices.size()) {
    throw std::invalid_argument("chunked mesh: give one vertex id per vertex, or none");
  }
  std::map<ChunkKey, MeshChunk> next = ChunkCutter(mesh, vertex_ids, chunk_size_m_).take();
  for (auto at = next.begin(); at != next.end();) {
    at = is_final(at->first, line) ? next.erase(at) : std::next(at);
  }
  ChunkDelta delta;
  for (auto& [key, chunk] : next) {
    const auto old = chunks_.find(key);
    if (old != chunks_.end() && same_content(old->second, chunk)) {
      chunk.revision = old->second.revision;
      continue;
    }
    chunk.revision = ++last_revision_[key];
    delta.changed.push_back(chunk);
  }
  for (const auto& [key, chunk] : chunks_) {
    if (next.count(key) == 0) {
      delta.removed.push_back(key);
    }
  }
  chunks_ = std::move(next);
  delta.frozen = freeze(line);
  return delta;
}

bool ChunkedMesh::is_final(const ChunkKey& key, const FreezeLine& line) const {
  return frozen_.count(key) > 0 || is_outside_between(line_, line, cell_of(key, chunk_size_m_));
}

std::vector<MeshChunk> ChunkedMesh::freeze(const FreezeLine& line) {
  line_ = line;
  std::vector<MeshChunk> frozen;
  for (auto at = chunks_.begin(); at != chunks_.end();) {
    if (!line.is_outside(cell_of(at->first, chunk_size_m_))) {
      ++at;
      continue;
    }
    frozen_.insert(at->first);
    last_revision_.erase(at->first);
    frozen.push_back(std::move(at->second));
    at = chunks_.erase(at);
  }
  return frozen;
}

std::size_t ChunkedMesh::bytes() const {
  constexpr std::size_t kTreeNode = 64;  // of a set or map with small entries, on the heap
  std::size_t bytes = kTreeNode * (frozen_.size() + last_revision_.size() + chunks_.size());
  for (const auto& [key, chunk] : chunks_) {
    bytes += chunk.bytes();
  }
  return bytes;
}

void ChunkedMesh::clear() {
  chunks_.clear();
  frozen_.clear();
  line_ = {};
}

TriangleMesh assemble(const std::vector<const MeshChunk*>& chunks) {
  TriangleMesh mesh;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of_id;
  for (const MeshChunk* chunk : chunks) {
    check_chunk(*chunk);
    std::vector<std::uint32_t> global(chunk->vertices.size());
    for (std::size_t v = 0; v < global.size(); ++v) {
      const auto [at, is_new] = index_of_id.try_emplace(
          chunk->vertex_ids[v], static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        mesh.vertices.emplace_back(chunk->origin + chunk->vertices[v].cast<double>());
      }
      global[v] = at->second;
    }
    for (const Triangle& t : chunk->triangles) {
      mesh.triangles.push_back({global[t[0]], global[t[1]], global[t[2]]});
    }
    mesh.labels.insert(mesh.labels.end(), chunk->labels.begin(), chunk->labels.end());
    mesh.views.insert(mesh.views.end(), chunk->views.begin(), chunk->views.end());
    for (const std::uint8_t confidence : chunk->confidence) {
      mesh.confidence.push_back(static_cast<float>(confidence) / 255.0F);
    }
  }
  validate(mesh);
  return mesh;
}

}  // namespace facet_mapping
