// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Cells of a regular grid, packed into 64 bits for hash tables.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace facet_mapping::carving {

using GridCell = Eigen::Matrix<std::int64_t, 3, 1>;

/// The cell in which a point lies, of a grid with a corner in the origin.
inline GridCell grid_cell(const Eigen::Vector3d& point, double spacing_m) {
  return (point / spacing_m).array().floor().cast<std::int64_t>();
}

constexpr unsigned kGridAxisBits = 21;
constexpr std::uint64_t kGridAxisMask = (1ULL << kGridAxisBits) - 1U;

/// Cells two million cells apart share a key.
inline std::uint64_t grid_key(const GridCell& cell) {
  return (static_cast<std::uint64_t>(cell.x()) & kGridAxisMask) |
         (static_cast<std::uint64_t>(cell.y()) & kGridAxisMask) << kGridAxisBits |
         (static_cast<std::uint64_t>(cell.z()) & kGridAxisMask) << 2U * kGridAxisBits;
}

/// The coordinate of a key's cell along an axis (0 .. 2), sign restored.
inline std::int64_t grid_coordinate(std::uint64_t key, unsigned axis) {
  const auto bits = static_cast<std::int64_t>(key >> (axis * kGridAxisBits) & kGridAxisMask);
  constexpr auto kRange = static_cast<std::int64_t>(kGridAxisMask) + 1;
  return bits >= kRange / 2 ? bits - kRange : bits;
}

}  // namespace facet_mapping::carving
