// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mapping/chunk_bytes.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace facet_mapping {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error("a chunk of the mesh is damaged");
}

std::uint64_t checksum(const char* data, std::size_t size) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (std::size_t k = 0; k < size; ++k) {
    hash = (hash ^ static_cast<unsigned char>(data[k])) * 1099511628211ULL;
  }
  return hash;
}

template <typename Value>
void put(const Value* values, std::size_t count, std::vector<char>* bytes) {
  const auto* data = reinterpret_cast<const char*>(values);
  bytes->insert(bytes->end(), data, data + count * sizeof(Value));
}

template <typename Value>
void put(const std::vector<Value>& values, std::vector<char>* bytes) {
  const std::uint64_t size = values.size();
  put(&size, 1, bytes);
  put(values.data(), values.size(), bytes);
}

class Reader {
 public:
  Reader(const char* data, std::size_t size) : data_(data), left_(size) {}

  template <typename Value>
  void get(Value* values, std::size_t count) {
    if (count > left_ / sizeof(Value)) {
      fail();
    }
    if (count > 0) {
      std::memcpy(static_cast<void*>(values), data_, count * sizeof(Value));
    }
    data_ += count * sizeof(Value);
    left_ -= count * sizeof(Value);
  }

  template <typename Value>
  void get(std::vector<Value>* values) {
    std::uint64_t size = 0;
    get(&size, 1);
    if (size > left_ / sizeof(Value)) {
      fail();
    }
    values->resize(size);
    get(values->data(), size);
  }

 private:
  const char* data_;
  std::size_t left_;
};

}  // namespace

void append_chunk(const MeshChunk& chunk, std::vector<char>* bytes) {
  const std::size_t start = bytes->size();
  put(chunk.key.data(), chunk.key.size(), bytes);
  put(&chunk.revision, 1, bytes);
  put(chunk.origin.data(), 3, bytes);
  put(chunk.vertices, bytes);
  put(chunk.vertex_ids, bytes);
  put(chunk.triangles, bytes);
  put(chunk.labels, bytes);
  put(chunk.confidence, bytes);
  put(chunk.views, bytes);
  const std::uint64_t sum = checksum(bytes->data() + start, bytes->size() - start);
  put(&sum, 1, bytes);
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
  MeshChunk chunk;
  Reader reader(bytes.data(), size);
  reader.get(chunk.key.data(), chunk.key.size());
  reader.get(&chunk.revision, 1);
  reader.get(chunk.origin.data(), 3);
  reader.get(&chunk.vertices);
  reader.get(&chunk.vertex_ids);
  reader.get(&chunk.triangles);
  reader.get(&chunk.labels);
  reader.get(&chunk.confidence);
  reader.get(&chunk.views);
  return chunk;
}

}  // namespace facet_mapping
