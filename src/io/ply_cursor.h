// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the numbers of a PLY body one after the other, whatever the encoding.
#pragma once

#include <cstddef>
#include <string_view>

#include "ply_header.h"

namespace facet_mapping::ply {

/// True for 0, 1, 2 ... `largest`; false for fractions, NaN and the rest.
bool is_whole(double value, double largest);

/// All PLY types fit a double without loss.
class Cursor {
 public:
  Cursor(std::string_view body, Format format) : body_(body), format_(format) {}

  /// Throws std::runtime_error at the end of the body or on a word that is no number.
  double read(Type type) { return format_ == Format::kAscii ? read_word() : read_binary(type); }

  /// A list's length. Throws also if it is negative or more than the rest of the body can hold.
  std::size_t read_count(const Property& list);

  void skip(const Property& property);

 private:
  double read_word();
  double read_binary(Type type);

  std::string_view body_;
  Format format_;
  std::size_t offset_ = 0;
};

}  // namespace facet_mapping::ply
