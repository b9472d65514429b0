// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Values as bytes and back, bit for bit, for files that machines of the same kind read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace facet_mapping {

/// FNV-1a.
std::uint64_t checksum(const char* data, std::size_t size);

/// Appends to bytes that are kept elsewhere.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<char>* bytes) : bytes_(bytes) {}

  template <typename Value>
  void put(const Value* values, std::size_t count) {
    const auto* data = reinterpret_cast<const char*>(values);
    bytes_->insert(bytes_->end(), data, data + count * sizeof(Value));
  }
  template <typename Value>
  void put(const Value& value) {
    put(&value, 1);
  }
  /// How many there are, and then the values.
  template <typename Value>
  void put_all(const std::vector<Value>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    put(values.data(), values.size());
  }

 private:
  std::vector<char>* bytes_;
};

/// Reads what ByteWriter wrote. Throws std::out_of_range at the end of the bytes, which must
/// outlive the reader.
class ByteReader {
 public:
  ByteReader(const char* data, std::size_t size) : data_(data), left_(size) {}

  template <typename Value>
  void get(Value* values, std::size_t count) {
    if (count > left_ / sizeof(Value)) {
      throw std::out_of_range("more values than bytes");
    }
    if (count > 0) {
      std::memcpy(static_cast<void*>(values), data_, count * sizeof(Value));
    }
    data_ += count * sizeof(Value);
    left_ -= count * sizeof(Value);
  }
  template <typename Value>
  Value get() {
    Value value{};
    get(&value, 1);
    return value;
  }
  template <typename Value>
  std::vector<Value> get_all() {
    const auto count = get<std::uint64_t>();
    if (count > left_ / sizeof(Value)) {  // before memory is taken for them
      throw std::out_of_range("more values than bytes");
    }
    std::vector<Value> values(count);
    get(values.data(), count);
    return values;
  }

 private:
  const char* data_;
  std::size_t left_;
};

}  // namespace facet_mapping
