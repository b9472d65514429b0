// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A chunk made ready for drawing: one vertex per facet carries what belongs to the facet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Geometry>
#include <facet_mapping/LabeledMeshChunk.h>

#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/rviz/class_table.h"

namespace facet_mapping {

inline ChunkKey key_of(const LabeledMeshChunk& chunk) {
  return {chunk.key[0], chunk.key[1], chunk.key[2]};
}

/// `normal` and `facet` are those of the one facet whose last corner it
/// is: the shader takes them unblended (`flat`) from there.
struct FacetVertex {
  std::array<float, 3> position{};      ///< relative to the chunk's origin, metres
  std::array<std::int8_t, 4> normal{};  ///< -127..127 = -1..1; zero if the facet has no area
  std::array<std::uint8_t, 4> facet{};  ///< class slot, confidence, views (at most 255), chunk
};

/// The chunk for the far view, its vertices drawn together on a grid.
struct CoarseLevel {
  float cell_m = 0.0F;                 ///< edge of the grid's cells: nothing leaves its cell
  std::vector<std::uint32_t> indices;  ///< as those of ChunkGeometry
};

struct ChunkGeometry {
  std::vector<FacetVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three per facet, counter-clockwise from free space
  std::vector<bool> on_border;  ///< of the chunk's surface: per vertex, those of levels excepted
  std::vector<CoarseLevel> levels;  ///< from fine to coarse, each at most half of the one before
  Eigen::AlignedBox3f box;          ///< of what is drawn, relative to the origin; empty if nothing
  std::map<std::uint8_t, double> area_by_slot_m2;
  std::size_t bad_facets = 0;   ///< left out: index out of range, or a vertex that is not finite
  bool bad_attributes = false;  ///< an array of wrong length was taken as absent
  bool has_confidence = false;  ///< false: each facet's is taken as full
  bool has_views = false;       ///< false: each facet is taken as seen
};

/// Copes with whatever a message may hold. About one vertex per facet: facets share vertices as
/// long as each has one of its own to be last. `slots`: of the chunk's labels.
ChunkGeometry make_chunk_geometry(const LabeledMeshChunk& chunk, const ClassSlots& slots);

/// Fills `levels`, and appends the vertices that they need. Chunks side by side stay joined: they
/// draw their common border together in the same way. `origin`: of the chunk, metres.
void add_coarse_levels(const Eigen::Vector3d& origin, ChunkGeometry* geometry);

}  // namespace facet_mapping
