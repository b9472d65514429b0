// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes and class lists to messages and back.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include <facet_mapping/ClassPalette.h>
#include <facet_mapping/LabeledMesh.h>
#include <visualization_msgs/MarkerArray.h>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/mapping/chunked_mesh.h"

namespace facet_mapping {

LabeledMeshChunk chunk_to_message(const MeshChunk& chunk);

/// Throws std::invalid_argument if the arrays do not fit each other or name vertices that are not
/// there.
MeshChunk chunk_from_message(const LabeledMeshChunk& message);

/// Welds the chunks of a full message. Throws std::invalid_argument as above.
TriangleMesh mesh_from_message(const LabeledMesh& message);

ClassPalette palette_message(const LabelSet& labels,
                             const std::string& source,
                             std::uint32_t version);

/// TRIANGLE_LIST markers for a display without our plugin: one per class, in a namespace named like
/// the class, in its colour. A mesh above `max_triangles` is decimated.
/// `shown` holds the classes shown so far: those that are gone get a DELETE, and an empty
/// TRIANGLE_LIST, on which rviz stumbles, is never made.
visualization_msgs::MarkerArray markers_from_mesh(const TriangleMesh& mesh,
                                                  const LabelSet& labels,
                                                  const std_msgs::Header& header,
                                                  std::size_t max_triangles,
                                                  std::set<Label>* shown);

/// Vertex clustering on a grid that is made coarser until at most `max_triangles` remain. For
/// display only: the result need not be a manifold.
TriangleMesh decimate_for_display(const TriangleMesh& mesh, std::size_t max_triangles);

}  // namespace facet_mapping
