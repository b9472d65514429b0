// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/vertex_ids.h"

#include <cstring>
#include <utility>

#include "hash_bits.h"

namespace facet_mapping {

std::size_t VertexIds::Hash::operator()(const Eigen::Vector3d& p) const {
  std::uint64_t hash = 0;
  for (const double value : p) {
    std::uint64_t bits = 0;
    const double positive_zero = value + 0.0;  // -0 equals 0
    std::memcpy(&bits, &positive_zero, sizeof(bits));
    hash = add_to_hash(hash, bits);
  }
  return hash;
}

std::vector<std::uint32_t> VertexIds::number(const std::vector<Eigen::Vector3d>& points) {
  Ids now;
  now.reserve(points.size());
  std::vector<std::uint32_t> numbers;
  numbers.reserve(points.size());
  for (const Eigen::Vector3d& p : points) {
    const auto old = ids_.find(p);
    const auto [place, is_first] = now.emplace(p, old == ids_.end() ? next_ : old->second);
    const bool is_new = !is_first || old == ids_.end();  // of two vertices in one place, one is new
    numbers.push_back(is_new ? next_++ : place->second);
  }
  ids_ = std::move(now);
  return numbers;
}

}  // namespace facet_mapping
