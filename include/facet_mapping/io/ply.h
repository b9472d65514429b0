// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Labelled meshes as PLY that MeshLab and CloudCompare show in class colours.
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
/// disk never leaves half a mesh. Makes missing folders. Throws std::runtime_error with a sentence.
void write_ply(const std::string& path, const MeshFile& file);

/// Reads PLY (binary or ASCII; colours and unknown properties are skipped). Throws
/// std::runtime_error that says what is wrong and where (truncated, not a PLY, no faces ...).
MeshFile read_ply(const std::string& path);

}  // namespace facet_mapping
