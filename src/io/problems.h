// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Collects everything that is wrong with a dataset, so that one run tells it all.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace facet_mapping {

class Problems {
 public:
  void add(const std::string& sentence) { sentences_.push_back(sentence); }
  void add_missing(const std::string& path) { add("missing: " + path); }
  bool empty() const { return sentences_.empty(); }

  /// Throws std::runtime_error with the first ten problems and the number of the others.
  void throw_if_any(const std::string& folder) const;

 private:
  std::vector<std::string> sentences_;
};

}  // namespace facet_mapping
