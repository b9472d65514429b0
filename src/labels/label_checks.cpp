// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_checks.h"

#include <algorithm>

namespace facet_mapping::detail {
namespace {

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20U || c == '\x7f';
  });
}

}  // namespace

std::string color_text(const Rgb& color) {
  return "[" + std::to_string(color[0]) + ", " + std::to_string(color[1]) + ", " +
         std::to_string(color[2]) + "]";
}

void ClassChecker::complain_if_known(const std::string& value, const std::string& place) {
  const auto [first, is_new] = place_of_.emplace(value, place);
  if (!is_new) {
    add(place + ": " + value + " is already used at " + first->second);
  }
}

void ClassChecker::check_id(Label id, const std::string& place) {
  if (id == kUnlabelled) {
    add(place + ": id 65535 is reserved for \"no class is known\"");
  }
  complain_if_known("id " + std::to_string(id), place);
}

void ClassChecker::check_name(const std::string& name, const std::string& place) {
  if (name.empty()) {
    add(place + ": the name is empty");
  } else if (has_control_character(name)) {
    add(place + ": the name holds a line break or another control character");
  } else {
    complain_if_known("name '" + name + "'", place);
  }
}

void ClassChecker::check_color(const Rgb& color, const std::string& place) {
  complain_if_known("color " + color_text(color), place);
}

std::string join_problems(const std::string& title, const std::vector<std::string>& problems) {
  std::string text = title + " (" + std::to_string(problems.size()) +
                     (problems.size() == 1 ? " problem):" : " problems):");
  for (const std::string& problem : problems) {
    text += "\n  " + problem;
  }
  return text;
}

}  // namespace facet_mapping::detail
