// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The Delaunay triangulation and what its cells and vertices carry. Heavy: for carving/*.cpp only.
#pragma once

#include <cstdint>
#include <vector>

#include "carving/evidence.h"
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace facet_mapping::carving {

struct CellInfo {
  std::uint32_t epoch = 0;          ///< batch that created the cell
  std::uint32_t order = 0;          ///< numbered anew at each extraction, for deterministic ties
  Weight free = 0;                  ///< free-space evidence
  LabelEvidence labels;             ///< label evidence of rays that end just in front
  std::vector<std::uint32_t> rays;  ///< rays that cross the cell (front or behind part)
  bool in_free_set = false;         ///< inside the manifold free space
  bool is_free = false;             ///< what the evidence alone says
};

struct VertexInfo {
  std::uint32_t id = 0;          ///< permanent
  std::uint32_t free_cells = 0;  ///< incident cells inside the manifold free space
  std::uint32_t rays = 0;        ///< rays that end here
  bool steiner = false;
  LabelEvidence labels;  ///< labels of the points that this vertex stands for
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel>;
using Tds = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Tds>;
using CellHandle = Triangulation::Cell_handle;
using VertexHandle = Triangulation::Vertex_handle;
using Point = Kernel::Point_3;

}  // namespace facet_mapping::carving
