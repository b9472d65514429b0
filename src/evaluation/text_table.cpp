// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/text_table.h"

#include <algorithm>
#include <cstdio>

namespace facet_mapping {
namespace {

std::size_t columns_of(const std::string& text) {
  // UTF-8 continuation bytes take no room.
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string padded_left(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, columns_of(text)), ' ') + text;
}

std::string padded_right(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, columns_of(text)), ' ');
}

}  // namespace

std::string format_number(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
}

std::string grouped_digits(std::size_t number) {
  std::string text = std::to_string(number);
  for (auto k = static_cast<std::ptrdiff_t>(text.size()) - 3; k > 0; k -= 3) {
    text.insert(static_cast<std::size_t>(k), ",");
  }
  return text;
}

std::string aligned_rows(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(1, 0);
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; row.size() > 1 && k < row.size(); ++k) {
      widths[k] = std::max(widths[k], columns_of(row[k]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = padded_right(row.at(0), widths[0]);
    for (std::size_t k = 1; k < row.size(); ++k) {
      line += "  " + padded_left(row[k], widths[k]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace facet_mapping
