// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a PLY file: what its body holds, in which order and encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace facet_mapping::ply {

enum class Format { kAscii, kLittleEndian, kBigEndian };
enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t size_of(Type type);

struct Property {
  std::string name;
  Type type = Type::kFloat32;
  bool is_list = false;
  Type count_type = Type::kUint8;  ///< of lists
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::kAscii;
  std::vector<Element> elements;
  std::vector<std::string> comments;  ///< without the word "comment"
  std::size_t body_offset = 0;        ///< bytes
};

/// Throws std::runtime_error with a sentence (without the file's name).
Header parse_header(std::string_view content);

/// Throws std::runtime_error if the bytes after the header cannot hold what the header announces.
void check_size(const Header& header, std::size_t content_size);

}  // namespace facet_mapping::ply
