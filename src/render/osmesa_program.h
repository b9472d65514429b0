// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The shader program that writes facet index + 1 and camera z.
#pragma once

#include "render/osmesa_functions.h"

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

struct OsmesaProgram {
  GLuint id = 0;
  GLint scale_and_offset = -1;
  GLint near_depth = -1;
};

/// Throws std::runtime_error with the compiler's message.
OsmesaProgram make_osmesa_program(const OsmesaFunctions& gl);

/// Selects the program and sets the camera.
void use_osmesa_program(const OsmesaFunctions& gl,
                        const OsmesaProgram& program,
                        const PinholeCamera& camera);

}  // namespace facet_mapping
