// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which views are compared with which (after Romanoni & Matteucci 2019: coverage, overlap,
// resolution, parallax).
#pragma once

#include <vector>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/surface_view.h"

namespace facet_mapping {

struct ViewPairConfig {
  int pairs_per_view = 3;             ///< partners kept for each view, at most
  double best_parallax_deg = 10.0;    ///< angle between the viewing rays that says most
  double min_shared_fraction = 0.01;  ///< score below which a partner says nothing, 0..1
};

/// How much a surface point seen under this parallax tells: 1 at the best angle, falling as the
/// square of the angle below it (as the information does) and likewise above it, where the
/// appearance changes.
double parallax_score(double parallax_deg, double best_parallax_deg);

/// partners[i] lists the views that view i is compared with, best first. Points of the rendered
/// surface are scored by visibility in both views, parallax, ratio of the resolutions and incidence
/// in the partner; partners are added one by one for what they add to those already chosen, so that
/// together they cover the image. For a camera driving forward this prefers frames some metres
/// apart over neighbours without parallax.
std::vector<std::vector<int>> select_view_pairs(const TriangleMesh& mesh,
                                                const std::vector<View>& views,
                                                const std::vector<SurfaceView>& surfaces,
                                                const ViewPairConfig& config);

}  // namespace facet_mapping
