// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/segmentation/forest_model.h"

namespace facet_mapping {

float ForestModel::add_votes(const float* cell, float* votes) const {
  float sum = 0.0F;
  for (const std::int32_t root : roots) {
    const std::uint8_t* shares = &leaves[leaf(root, cell) * classes.size()];
    for (std::size_t c = 0; c < classes.size(); ++c) {
      votes[c] += shares[c];
      sum += shares[c];
    }
  }
  return sum;
}

}  // namespace facet_mapping
