// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "seen_classes.h"

#include <array>
#include <cstdio>

namespace facet_mapping {
namespace {

constexpr int kStride = 4;  // a sixteenth of the pixels says enough

void append(std::string* text, const std::string& item) {
  *text += (text->empty() ? "" : ", ") + item;
}

std::string numbered(Label id, const std::string& name) {
  return id == kUnlabelled ? name : std::to_string(id) + " " + name;
}

std::string percent(std::size_t part, std::size_t whole) {
  std::array<char, 16> text{};
  std::snprintf(text.data(),
                text.size(),
                "%.1f %%",
                100.0 * static_cast<double>(part) / static_cast<double>(whole));
  return text.data();
}

}  // namespace

void SeenClasses::add(const cv::Mat& ids, const LabelImageReport& report) {
  for (int row = kStride / 2; row < ids.rows; row += kStride) {
    for (int column = kStride / 2; column < ids.cols; column += kStride) {
      ++pixels_[ids.at<Label>(row, column)];
    }
  }
  for (const auto& [id, pixels] : report.unknown_ids) {
    unknown_[id] += pixels;
  }
}

std::string SeenClasses::seen() const {
  std::size_t all = 0;
  for (const auto& [id, pixels] : pixels_) {
    all += pixels;
  }
  std::string text;
  for (const auto& [id, pixels] : pixels_) {
    append(&text, numbered(id, labels_.name_of(id)) + " " + percent(pixels, all));
  }
  return text;
}

std::string SeenClasses::unknown() const {
  std::string text;
  for (const auto& [id, pixels] : unknown_) {
    append(&text, std::to_string(id) + " (" + std::to_string(pixels) + " pixels)");
  }
  return text;
}

std::string SeenClasses::configured() const {
  std::string text;
  for (const ClassInfo& info : labels_.classes()) {
    append(&text, numbered(info.id, info.name));
  }
  return text;
}

std::string SeenClasses::never_seen() const {
  std::string text;
  for (const ClassInfo& info : labels_.classes()) {
    if (!info.ignore && pixels_.count(info.id) == 0) {
      append(&text, numbered(info.id, info.name));
    }
  }
  return text;
}

}  // namespace facet_mapping
