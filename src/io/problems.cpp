// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems.h"

#include <algorithm>
#include <stdexcept>

namespace facet_mapping {

void Problems::throw_if_any(const std::string& folder) const {
  if (sentences_.empty()) {
    return;
  }
  constexpr std::size_t kShown = 10;
  std::string text = "the dataset '" + folder + "' is not usable (" +
                     std::to_string(sentences_.size()) +
                     (sentences_.size() == 1 ? " problem):" : " problems):");
  for (std::size_t k = 0; k < std::min(kShown, sentences_.size()); ++k) {
    text += "\n  " + sentences_[k];
  }
  if (sentences_.size() > kShown) {
    text += "\n  and " + std::to_string(sentences_.size() - kShown) + " more";
  }
  throw std::runtime_error(text);
}

}  // namespace facet_mapping
