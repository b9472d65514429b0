// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_header.h"

#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace facet_mapping::ply {
namespace {

constexpr std::array<std::pair<const char*, Type>, 16> kTypeNames{{
    {"char", Type::kInt8},
    {"int8", Type::kInt8},
    {"uchar", Type::kUint8},
    {"uint8", Type::kUint8},
    {"short", Type::kInt16},
    {"int16", Type::kInt16},
    {"ushort", Type::kUint16},
    {"uint16", Type::kUint16},
    {"int", Type::kInt32},
    {"int32", Type::kInt32},
    {"uint", Type::kUint32},
    {"uint32", Type::kUint32},
    {"float", Type::kFloat32},
    {"float32", Type::kFloat32},
    {"double", Type::kFloat64},
    {"float64", Type::kFloat64},
}};

Type parse_type(const std::string& name) {
  for (const auto& [known, type] : kTypeNames) {
    if (name == known) {
      return type;
    }
  }
  throw std::runtime_error("unknown type '" + name + "'");
}

// Lines end with \n or \r\n.
class LineReader {
 public:
  explicit LineReader(std::string_view content) : content_(content) {}

  std::optional<std::string> next() {
    const std::size_t end = content_.find('\n', offset_);
    if (end == std::string_view::npos) {
      return std::nullopt;
    }
    std::string line(content_.substr(offset_, end - offset_));
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    offset_ = end + 1;
    return line;
  }
  std::size_t offset() const { return offset_; }

 private:
  std::string_view content_;
  std::size_t offset_ = 0;
};

Format parse_format(std::istringstream& words) {
  std::string name;
  std::string version;
  words >> name >> version;
  if (version != "1.0") {
    throw std::runtime_error("format version '" + version + "' instead of 1.0");
  }
  if (name == "ascii") {
    return Format::kAscii;
  }
  if (name == "binary_little_endian") {
    return Format::kLittleEndian;
  }
  if (name == "binary_big_endian") {
    return Format::kBigEndian;
  }
  throw std::runtime_error("unknown format '" + name + "'");
}

Element parse_element(std::istringstream& words) {
  Element element;
  std::string count;
  words >> element.name >> count;
  const char* end = count.data() + count.size();
  const auto [parsed, error] = std::from_chars(count.data(), end, element.count);
  if (count.empty() || error != std::errc() || parsed != end) {
    throw std::runtime_error("element '" + element.name + "' with the count '" + count + "'");
  }
  return element;
}

Property parse_property(std::istringstream& words) {
  Property property;
  std::string type;
  words >> type;
  if (type == "list") {
    property.is_list = true;
    words >> type;
    property.count_type = parse_type(type);
    words >> type;
  }
  property.type = parse_type(type);
  words >> property.name;
  if (property.name.empty()) {
    throw std::runtime_error("a property without a name");
  }
  return property;
}

// What follows the keyword "comment " on the line.
std::string comment_of(const std::string& line) {
  constexpr std::size_t kKeyword = 8;
  return line.size() > kKeyword ? line.substr(kKeyword) : std::string();
}

struct HeaderState {
  Header header;
  bool has_format = false;
  bool ended = false;
};

void parse_line(const std::string& line, HeaderState& state) {
  std::istringstream words(line);
  std::string keyword;
  words >> keyword;
  if (keyword == "end_header") {
    state.ended = true;
  } else if (keyword == "format") {
    state.header.format = parse_format(words);
    state.has_format = true;
  } else if (keyword == "comment") {
    state.header.comments.push_back(comment_of(line));
  } else if (keyword == "element") {
    state.header.elements.push_back(parse_element(words));
  } else if (keyword == "property") {
    if (state.header.elements.empty()) {
      throw std::runtime_error("a property before any element");
    }
    state.header.elements.back().properties.push_back(parse_property(words));
  } else if (keyword != "obj_info" && !keyword.empty()) {
    throw std::runtime_error("unknown keyword '" + keyword.substr(0, 40) + "'");
  }
}

// The fewest bytes that one row of the element can take.
std::size_t smallest_row(const Element& element, Format format) {
  std::size_t bytes = 0;
  for (const Property& property : element.properties) {
    if (format == Format::kAscii) {
      bytes += 2;  // a digit and a separator
    } else {
      bytes += size_of(property.is_list ? property.count_type : property.type);
    }
  }
  return bytes;
}

}  // namespace

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

Header parse_header(std::string_view content) {
  if (content.empty()) {
    throw std::runtime_error("the file is empty");
  }
  LineReader lines(content);
  const std::optional<std::string> magic = lines.next();
  if (!magic || *magic != "ply") {
    throw std::runtime_error("not a PLY file: it does not begin with the line 'ply'");
  }
  HeaderState state;
  for (int number = 2; !state.ended; ++number) {
    const std::optional<std::string> line = lines.next();
    if (!line) {
      throw std::runtime_error("truncated: the file ends inside its header (no 'end_header')");
    }
    try {
      parse_line(*line, state);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("header line " + std::to_string(number) + ": " + error.what());
    }
  }
  if (!state.has_format) {
    throw std::runtime_error("the header has no 'format' line");
  }
  state.header.body_offset = lines.offset();
  return state.header;
}

void check_size(const Header& header, std::size_t content_size) {
  // One byte more: the last number of an ASCII file needs no separator behind it.
  std::size_t left = content_size - header.body_offset + (header.format == Format::kAscii ? 1 : 0);
  for (const Element& element : header.elements) {
    const std::size_t row = smallest_row(element, header.format);
    if (row > 0 && element.count > left / row) {
      throw std::runtime_error("truncated: the header announces " + std::to_string(element.count) +
                               " of element '" + element.name + "', but only " +
                               std::to_string(left) + " bytes are left for them");
    }
    left -= row * element.count;
  }
}

}  // namespace facet_mapping::ply
