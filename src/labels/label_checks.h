// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that both ways of making a LabelSet share.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping::detail {

/// One number per colour, the key of every colour look-up.
inline std::uint32_t pack_color(const Rgb& color) {
  return (static_cast<std::uint32_t>(color[0]) << 16U) |
         (static_cast<std::uint32_t>(color[1]) << 8U) | color[2];
}

/// "[128, 64, 128]"
std::string color_text(const Rgb& color);

/// Collects what is wrong with the classes of one list; `place` says where a value stands.
class ClassChecker {
 public:
  void check_id(Label id, const std::string& place);
  void check_name(const std::string& name, const std::string& place);
  void check_color(const Rgb& color, const std::string& place);
  void add(const std::string& problem) { problems_.push_back(problem); }

  const std::vector<std::string>& problems() const { return problems_; }

 private:
  void complain_if_known(const std::string& value, const std::string& place);

  std::vector<std::string> problems_;
  std::map<std::string, std::string> place_of_;  // value ("id 7") -> where it was used first
};

/// "TITLE (2 problems):" and one indented line per problem.
std::string join_problems(const std::string& title, const std::vector<std::string>& problems);

}  // namespace facet_mapping::detail
