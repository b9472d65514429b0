// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The vertex and face elements of a PLY body.
#pragma once

#include "ply_cursor.h"
#include "ply_header.h"

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping::ply {

/// Reads all rows of `element` into `mesh`; elements other than "vertex" and "face" are skipped.
/// Throws std::runtime_error naming the row.
void read_element(const Element& element, Cursor& cursor, TriangleMesh& mesh);

}  // namespace facet_mapping::ply
