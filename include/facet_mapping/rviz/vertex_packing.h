// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices of a chunk in 12 bytes each, as they lie on the graphics card.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Geometry>

#include "facet_mapping/rviz/chunk_geometry.h"

namespace facet_mapping {

/// The vertex shader unpacks the normal (mesh_shaders.h).
struct PackedVertex {
  std::array<std::int16_t, 3> position{};  ///< whole steps from VertexPacking::center
  std::int16_t normal = 0;                 ///< octahedral, 2 x 8 bits, within one degree
  std::array<std::uint8_t, 4> facet{};     ///< FacetVertex::facet
};
static_assert(sizeof(PackedVertex) == 12, "goes to the graphics card as it is");

/// Positions are rounded to whole steps of the mesh's frame, so that chunks side by side round what
/// they share alike.
class VertexPacking {
 public:
  VertexPacking() = default;
  /// `origin`: of the chunk in the mesh's frame; `box`: of its vertices relative to it. Metres.
  VertexPacking(const Eigen::Vector3d& origin, const Eigen::AlignedBox3f& box);

  PackedVertex pack(const FacetVertex& vertex) const;
  /// Exact but for the rounding of pack(); the position is relative to the chunk's origin.
  FacetVertex unpack(const PackedVertex& packed) const;

  /// A power of two: 1/4 mm for chunks of up to 16 m, and so on. Metres.
  double step_m() const { return step_m_; }
  /// In the mesh's frame.
  const Eigen::Vector3d& center() const { return center_; }

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double step_m_ = 1.0 / 4096.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
};

}  // namespace facet_mapping
