// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/steiner_grid.h"

#include <cmath>

namespace facet_mapping::carving {
namespace {

std::uint64_t mix(std::uint64_t value) {  // the finaliser of splitmix64
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}

double unit_interval(std::uint64_t hash) {
  return static_cast<double>(hash >> 11U) * 0x1.0p-53;
}

std::uint64_t node_key(std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t kMask = (1ULL << 21U) - 1U;
  return (static_cast<std::uint64_t>(x) & kMask) | (static_cast<std::uint64_t>(y) & kMask) << 21U |
         (static_cast<std::uint64_t>(z) & kMask) << 42U;
}

Eigen::Vector3d jitter(std::uint64_t key) {
  return {unit_interval(mix(key ^ 0x9E3779B97F4A7C15ULL)),
          unit_interval(mix(key + 1)),
          unit_interval(mix(key + 0xD1B54A32D192ED03ULL))};
}

}  // namespace

std::vector<Eigen::Vector3d> SteinerGrid::take_around(const Eigen::Vector3d& center) {
  std::vector<Eigen::Vector3d> nodes;
  if (spacing_m_ <= 0.0) {
    return nodes;
  }
  const auto reach = static_cast<std::int64_t>(std::ceil(reach_m_ / spacing_m_));
  const Eigen::Matrix<std::int64_t, 3, 1> middle =
      (center / spacing_m_).array().floor().cast<std::int64_t>();
  for (std::int64_t x = middle.x() - reach; x <= middle.x() + reach; ++x) {
    for (std::int64_t y = middle.y() - reach; y <= middle.y() + reach; ++y) {
      for (std::int64_t z = middle.z() - reach; z <= middle.z() + reach; ++z) {
        const std::uint64_t key = node_key(x, y, z);
        const Eigen::Vector3d node =
            spacing_m_ * (Eigen::Vector3d(x, y, z).array() + jitter(key).array()).matrix();
        if ((node - center).norm() <= reach_m_ && taken_.insert(key).second) {
          nodes.push_back(node);
        }
      }
    }
  }
  return nodes;
}

}  // namespace facet_mapping::carving
