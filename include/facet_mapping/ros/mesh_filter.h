// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a mesh that a request names: a box, classes.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <facet_mapping/BoxRegion.h>
#include <tf2_ros/buffer.h>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/geometry/mesh_part.h"

namespace facet_mapping {

/// All zero: no region was given.
bool is_everywhere(const BoxRegion& region);

/// Throws std::invalid_argument if a bound is not finite or min lies above max.
void validate(const BoxRegion& region);

/// The box along the map's axes around the region.
Eigen::AlignedBox3d box_in_map(const BoxRegion& region, const Eigen::Isometry3d& region_from_map);

/// Leads into the region's frame. Throws std::invalid_argument if tf does not know it.
Eigen::Isometry3d lookup_region_from_map(const BoxRegion& region,
                                         const std::string& map_frame,
                                         const tf2_ros::Buffer& buffer);

/// Throws std::invalid_argument as validate() does.
MeshPart part_of_request(const BoxRegion& region,
                         const Eigen::Isometry3d& region_from_map,
                         const std::vector<std::uint16_t>& classes);

/// The facets whose centroid lies inside the box (unless it is_everywhere) and whose class is in
/// `classes` (unless empty). `region_from_map` leads into the box's axes.
TriangleMesh filter_mesh(const TriangleMesh& mesh,
                         const BoxRegion& region,
                         const Eigen::Isometry3d& region_from_map,
                         const std::vector<Label>& classes);

}  // namespace facet_mapping
