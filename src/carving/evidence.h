// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Evidence in whole numbers, so that sums do not depend on the order in which rays arrive.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "carving/compact_vector.h"

#include "facet_mapping/geometry/label.h"

namespace facet_mapping::carving {

/// Evidence in units of 1/kRayWeight rays.
using Weight = std::uint32_t;
constexpr Weight kRayWeight = 256;

/// Free-space weight of a ray for a cell that reaches `distance_m` in front of the point:
/// 1 - exp(-d^2 / (2 sigma^2)) rays, so that the noise of a point does not carve its own surface
/// (soft visibility, Labatut et al. 2009).
Weight soft_weight(double distance_m, double sigma_m);

/// Weights of the few classes met in one place, in ascending class order. Points without a class
/// count under kUnlabelled: they tell matter, but no class.
class LabelEvidence {
 public:
  void add(Label label, Weight weight);
  void add(const LabelEvidence& other);
  /// Takes back what add() added; a class without evidence left is forgotten.
  void subtract(Label label, Weight weight);

  bool empty() const { return weights_.empty(); }
  Weight largest() const;
  Weight sum() const;
  /// The class with most evidence (the smaller id on a tie), kUnlabelled if there is none.
  Label best() const;
  /// (best - second best) / sum over the classes, 0 without evidence.
  float margin() const;
  std::vector<std::pair<Label, Weight>> weights() const {
    return {weights_.begin(), weights_.end()};
  }
  /// On the heap.
  std::size_t bytes() const { return weights_.capacity() * sizeof(Entry); }

 private:
  using Entry = std::pair<Label, Weight>;
  CompactVector<Entry> weights_;
};

}  // namespace facet_mapping::carving
