// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// For hash tables whose keys are several numbers.
#pragma once

#include <cstdint>

namespace facet_mapping {

/// Spreads `bits` over the hash of the numbers before (multiplier: the golden ratio, Knuth 6.4).
inline std::uint64_t add_to_hash(std::uint64_t hash, std::uint64_t bits) {
  hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
  return hash ^ hash >> 29U;
}

}  // namespace facet_mapping
