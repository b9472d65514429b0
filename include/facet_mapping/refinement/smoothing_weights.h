// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How much the images could tell about each vertex: the scale on which smoothing is weighed.
#pragma once

#include <vector>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/surface_view.h"

namespace facet_mapping {

/// Second derivative of the photometric energy of one pixel and one partner with good texture, by
/// the displacement along the normal in pixel footprints. 0.3: typical squared gradient over
/// variance of a well-textured window, per square pixel; 0.17: pixels that a point moves in a
/// partner at ten degrees of parallax.
constexpr double kPixelInformation = 0.3 * 0.17 * 0.17;

/// Per vertex, the curvature (per square metre) that the photometric energy would have with good
/// texture and partners at ten degrees of parallax: pixels that show the vertex's facets times
/// (f / z)^2. A vertex that a view sees between its pixels (facets smaller than a pixel) takes the
/// mean of its neighbours. Zero where no view sees the vertex: such vertices never move.
std::vector<double> smoothing_weights(const TriangleMesh& mesh,
                                      const std::vector<View>& views,
                                      const std::vector<SurfaceView>& surfaces,
                                      int partners_per_view);

}  // namespace facet_mapping
