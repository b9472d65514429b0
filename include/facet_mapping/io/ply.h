// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Labelled meshes as PLY that MeshLab and CloudCompare show in class colours.
//
// Written are: vertices `double x y z` (a float would lose 0.03 mm at 500 m) and, if there are
// labels, `uchar red green blue` of the commonest class around the vertex (CloudCompare knows no
// facet colours); faces `list uchar int vertex_indices`, `ushort label` (65535 = none), `float
// confidence`, `ushort views`, `uchar red green blue`; attributes that the mesh does not have are
// left out; comments `frame_id FRAME`, `class ID RED GREEN BLUE FLAGS NAME`, `class_alias ID RED
// GREEN BLUE`.
#pragma once

#include <string>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {

/// A mesh file's content: facets carry `label`, `confidence`, `views` and `red green blue`; class
/// list and frame stand in comments, so that nothing is lost on reading back.
struct MeshFile {
  TriangleMesh mesh;
  LabelSet labels;
  std::string frame_id;
};

/// Writes binary little-endian PLY to a temporary file beside `path` and renames it, so that a full
/// disk never leaves half a mesh. Makes missing folders. Throws std::runtime_error with a sentence,
/// also for a mesh without facets, and std::invalid_argument for an invalid mesh (see validate()).
void write_ply(const std::string& path, const MeshFile& file);

/// Reads PLY (binary of either byte order or ASCII; polygons become triangle fans; colours and
/// unknown properties are skipped; files of other programs have no labels, class list or frame).
/// Throws std::runtime_error that says what is wrong and where (truncated, not a PLY, no faces
/// ...).
MeshFile read_ply(const std::string& path);

}  // namespace facet_mapping
