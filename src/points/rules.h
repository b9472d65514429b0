// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contract checks that report every broken rule at once.
#pragma once

#include <stdexcept>
#include <string>

namespace facet_mapping::detail {

/// Gathers one clause per broken rule.
class Rules {
 public:
  void require(bool holds, const std::string& rule) {
    if (!holds) {
      broken_ += (broken_.empty() ? "" : "; ") + rule;
    }
  }

  /// Throws std::invalid_argument with `title` and all clauses.
  void throw_if_broken(const std::string& title) const {
    if (!broken_.empty()) {
      throw std::invalid_argument(title + broken_);
    }
  }

 private:
  std::string broken_;
};

}  // namespace facet_mapping::detail
