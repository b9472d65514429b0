// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The Delaunay triangulation and what its cells and vertices carry. Heavy: for carving/*.cpp only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "carving/compact_vector.h"
#include "carving/evidence.h"
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <Eigen/Core>

namespace facet_mapping::carving {

struct CellInfo {
  CompactVector<std::uint32_t> rays;  ///< that cross the cell (infinite cell: that leave the hull)
  LabelEvidence labels;               ///< label evidence of rays that end just in front
  Weight free = 0;                    ///< free-space evidence
  std::uint32_t order = 0;            ///< numbered anew at each use, for deterministic ties
  static constexpr std::int8_t kUnknown = -128;
  /// See sphere_cosine, in 1/127.
  std::array<std::int8_t, 4> cosine{kUnknown, kUnknown, kUnknown, kUnknown};
  bool is_new = true;        ///< made in this batch: no old ray's evidence is in it
  bool is_changed = true;    ///< its evidence changed since the last extraction
  bool in_region = false;    ///< takes part in the present cut
  bool is_free = false;      ///< what the evidence says
  bool in_free_set = false;  ///< inside the manifold free space
};

struct VertexInfo {
  std::uint32_t id = 0;          ///< its site
  std::uint32_t free_cells = 0;  ///< incident cells inside the manifold free space
  std::uint32_t rays = 0;        ///< rays that end on a surface here
  std::uint32_t mesh_index = 0;  ///< in the surface being made
  bool is_dirty = true;          ///< cells around it changed since the last growth
  bool must_check = false;       ///< a cell around it was taken into or out of the free space
  LabelEvidence labels;          ///< labels of the points that this vertex stands for
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, Kernel>;

/// A cell whose neighbours and vertices, all that a walk reads, lie in one cache line.
template <typename Base>
struct alignas(64) AlignedCell : Base {
  using Base::Base;
  template <typename Tds>
  struct Rebind_TDS {  // NOLINT(readability-identifier-naming): CGAL's name
    using Other = AlignedCell<typename Base::template Rebind_TDS<Tds>::Other>;
  };
};

using CellBase = AlignedCell<CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel>>;
using Tds = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Tds>;
using CellHandle = Triangulation::Cell_handle;
using VertexHandle = Triangulation::Vertex_handle;
using Point = Kernel::Point_3;
static_assert(sizeof(Tds::Cell) == 128, "two cache lines; millions of cells are held");

inline Point to_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Puts a cell into the manifold free space or takes it out.
inline void set_free(CellHandle cell, bool free) {
  if (cell->info().in_free_set == free) {
    return;
  }
  cell->info().in_free_set = free;
  for (int k = 0; k < 4; ++k) {
    VertexInfo& vertex = cell->vertex(k)->info();
    vertex.free_cells = free ? vertex.free_cells + 1 : vertex.free_cells - 1;
  }
}

/// Says that the surface around a cell must be looked at again.
inline void mark_dirty(CellHandle cell) {
  for (int k = 0; k < 4; ++k) {
    cell->vertex(k)->info().is_dirty = true;
  }
}

}  // namespace facet_mapping::carving
