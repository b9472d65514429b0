// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mapping/chunk_bytes.h"

#include <cstring>
#include <stdexcept>

#include "facet_mapping/io/byte_stream.h"

namespace facet_mapping {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error("a chunk of the mesh is damaged");
}

MeshChunk read_chunk(ByteReader reader) {
  MeshChunk chunk;
  reader.get(chunk.key.data(), chunk.key.size());
  chunk.revision = reader.get<std::uint32_t>();
  reader.get(chunk.origin.data(), 3);
  chunk.vertices = reader.get_all<Eigen::Vector3f>();
  chunk.vertex_ids = reader.get_all<std::uint32_t>();
  chunk.triangles = reader.get_all<Triangle>();
  chunk.labels = reader.get_all<Label>();
  chunk.confidence = reader.get_all<std::uint8_t>();
  chunk.views = reader.get_all<std::uint16_t>();
  return chunk;
}

}  // namespace

void append_chunk(const MeshChunk& chunk, std::vector<char>* bytes) {
  const std::size_t start = bytes->size();
  ByteWriter writer(bytes);
  writer.put(chunk.key.data(), chunk.key.size());
  writer.put(chunk.revision);
  writer.put(chunk.origin.data(), 3);
  writer.put_all(chunk.vertices);
  writer.put_all(chunk.vertex_ids);
  writer.put_all(chunk.triangles);
  writer.put_all(chunk.labels);
  writer.put_all(chunk.confidence);
  writer.put_all(chunk.views);
  writer.put(checksum(bytes->data() + start, bytes->size() - start));
}

MeshChunk parse_chunk(const std::vector<char>& bytes) {
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof(sum)) {
    fail();
  }
  const std::size_t size = bytes.size() - sizeof(sum);
  std::memcpy(&sum, bytes.data() + size, sizeof(sum));
  if (sum != checksum(bytes.data(), size)) {
    fail();
  }
  try {
    return read_chunk(ByteReader(bytes.data(), size));
  } catch (const std::out_of_range&) {
    fail();
  }
}

}  // namespace facet_mapping
