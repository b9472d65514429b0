// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What both render backends ask of their input.
#pragma once

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// Throws std::invalid_argument if the camera or pose is invalid or a facet names no vertex.
void check_render_input(const TriangleMesh& mesh, const View& view);

/// Throws std::invalid_argument naming the vertex.
[[noreturn]] void throw_vertex_not_finite(std::size_t vertex);

}  // namespace facet_mapping
