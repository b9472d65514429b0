// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/evidence.h"

#include <algorithm>
#include <cmath>

namespace facet_mapping::carving {

Weight soft_weight(double distance_m, double sigma_m) {
  constexpr double kFarInSigmas = 5.0;
  if (distance_m >= kFarInSigmas * sigma_m) {
    return kRayWeight;
  }
  const double z = distance_m / sigma_m;
  return static_cast<Weight>(std::lround(kRayWeight * -std::expm1(-0.5 * z * z)));
}

void LabelEvidence::add(Label label, Weight weight) {
  const auto at =
      std::lower_bound(weights_.begin(), weights_.end(), std::make_pair(label, Weight{0}));
  if (at != weights_.end() && at->first == label) {
    at->second += weight;
  } else {
    weights_.insert(at, {label, weight});
  }
}

void LabelEvidence::subtract(Label label, Weight weight) {
  const auto at =
      std::lower_bound(weights_.begin(), weights_.end(), std::make_pair(label, Weight{0}));
  if (at == weights_.end() || at->first != label) {
    return;
  }
  at->second -= std::min(at->second, weight);
  if (at->second == 0) {
    weights_.erase(at);
  }
}

void LabelEvidence::add(const LabelEvidence& other) {
  for (const auto& [label, weight] : other.weights_) {
    add(label, weight);
  }
}

Weight LabelEvidence::largest() const {
  Weight largest = 0;
  for (const auto& [label, weight] : weights_) {
    largest = std::max(largest, weight);
  }
  return largest;
}

Weight LabelEvidence::sum() const {
  Weight sum = 0;
  for (const auto& [label, weight] : weights_) {
    sum += weight;
  }
  return sum;
}

Label LabelEvidence::best() const {
  Label best = kUnlabelled;
  Weight most = 0;
  for (const auto& [label, weight] : weights_) {
    if (label != kUnlabelled && weight > most) {
      most = weight;
      best = label;
    }
  }
  return best;
}

float LabelEvidence::margin() const {
  Weight most = 0;
  Weight second = 0;
  double sum = 0.0;
  for (const auto& [label, weight] : weights_) {
    if (label == kUnlabelled) {
      continue;
    }
    sum += weight;
    second = std::max(second, std::min(most, weight));
    most = std::max(most, weight);
  }
  return sum > 0.0 ? static_cast<float>((most - second) / sum) : 0.0F;
}

}  // namespace facet_mapping::carving
