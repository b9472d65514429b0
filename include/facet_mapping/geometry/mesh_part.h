// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a mesh: a box, classes.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "facet_mapping/geometry/label.h"
#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

struct MeshPart {
  Eigen::AlignedBox3d box;  ///< along its own axes, metres; empty (the default): everywhere
  Eigen::Isometry3d box_from_mesh = Eigen::Isometry3d::Identity();
  std::vector<Label> classes;  ///< empty: all

  bool is_everything() const { return box.isEmpty() && classes.empty(); }
};

/// 1 for each facet whose centroid lies inside the box and whose class is one of the part's.
std::vector<std::uint8_t> facets_of_part(const TriangleMesh& mesh, const MeshPart& part);

/// 1 for each vertex all of whose facets are in `facets`: moving it changes no other facet.
std::vector<std::uint8_t> vertices_inside(const TriangleMesh& mesh,
                                          const std::vector<std::uint8_t>& facets);

}  // namespace facet_mapping
