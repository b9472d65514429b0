// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_cursor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace facet_mapping::ply {
namespace {

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
constexpr Format kHostFormat = Format::kBigEndian;
#else
constexpr Format kHostFormat = Format::kLittleEndian;
#endif

template <typename T>
double value_of(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double decode(const char* bytes, Type type) {
  switch (type) {
    case Type::kInt8:
      return value_of<std::int8_t>(bytes);
    case Type::kUint8:
      return value_of<std::uint8_t>(bytes);
    case Type::kInt16:
      return value_of<std::int16_t>(bytes);
    case Type::kUint16:
      return value_of<std::uint16_t>(bytes);
    case Type::kInt32:
      return value_of<std::int32_t>(bytes);
    case Type::kUint32:
      return value_of<std::uint32_t>(bytes);
    case Type::kFloat32:
      return value_of<float>(bytes);
    case Type::kFloat64:
      return value_of<double>(bytes);
  }
  return 0.0;
}

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

bool is_whole(double value, double largest) {
  return value >= 0.0 && value <= largest && std::floor(value) == value;
}

double Cursor::read_binary(Type type) {
  const std::size_t size = size_of(type);
  if (body_.size() - offset_ < size) {
    throw std::runtime_error("truncated: the file ends");
  }
  const char* bytes = body_.data() + offset_;
  offset_ += size;
  if (format_ == kHostFormat) {
    return decode(bytes, type);
  }
  std::array<char, 8> swapped{};
  std::reverse_copy(bytes, bytes + size, swapped.begin());
  return decode(swapped.data(), type);
}

double Cursor::read_word() {
  while (offset_ < body_.size() && is_space(body_[offset_])) {
    ++offset_;
  }
  if (offset_ == body_.size()) {
    throw std::runtime_error("truncated: the file ends");
  }
  const char* begin = body_.data() + offset_;
  const char* end = begin;
  while (end != body_.data() + body_.size() && !is_space(*end)) {
    ++end;
  }
  offset_ += static_cast<std::size_t>(end - begin);
  double value = 0.0;
  const char* digits = *begin == '+' ? begin + 1 : begin;
  const auto [parsed, error] = std::from_chars(digits, end, value);
  if (parsed != end || error == std::errc::invalid_argument) {
    throw std::runtime_error("'" + std::string(begin, std::min(end, begin + 40)) +
                             "' is no number");
  }
  // Out of range: strtod tells too large (infinity) from too small (zero or nearly so).
  return error == std::errc() ? value : std::strtod(std::string(digits, end).c_str(), nullptr);
}

std::size_t Cursor::read_count(const Property& list) {
  const double count = read(list.count_type);
  const std::size_t left = body_.size() - offset_;
  const std::size_t smallest = format_ == Format::kAscii ? 2 : size_of(list.type);
  if (!is_whole(count, 4294967295.0)) {
    throw std::runtime_error("the length of the list '" + list.name + "' is " +
                             std::to_string(count));
  }
  const auto length = static_cast<std::size_t>(count);
  if (length > (left + 1) / smallest) {
    throw std::runtime_error("truncated: the list '" + list.name + "' of length " +
                             std::to_string(length) + " does not fit the rest of the file");
  }
  return length;
}

void Cursor::skip(const Property& property) {
  const std::size_t count = property.is_list ? read_count(property) : 1;
  for (std::size_t k = 0; k < count; ++k) {
    read(property.type);
  }
}

}  // namespace facet_mapping::ply
