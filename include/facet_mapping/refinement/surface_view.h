// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh as one view sees it, with the pixels that photometry may trust.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

struct SurfaceView {
  FacetImage image;
  /// CV_8UC1, 255 where a facet is seen that is neither grazing nor beside a depth jump.
  cv::Mat usable;
  /// CV_8UC1, `usable` shrunk by two pixels: where a smooth sample of the image reads no pixel of
  /// another surface.
  cv::Mat sampled;
};

/// The largest depth step between neighbouring pixels that one facet seen at an incidence cosine of
/// at least `min_incidence_cos` can make at depth `z`: z / (f cos). Larger steps are depth jumps.
double largest_depth_step(const PinholeCamera& camera, double z, double min_incidence_cos);

/// `normals`: facet_normals(mesh). `min_incidence_cos` above 0.
SurfaceView make_surface_view(const TriangleMesh& mesh,
                              const std::vector<Eigen::Vector3d>& normals,
                              const View& view,
                              FacetImage image,
                              double min_incidence_cos);

/// Renders every view (in parallel) with the software rasteriser.
std::vector<SurfaceView> render_surfaces(const TriangleMesh& mesh,
                                         const std::vector<View>& views,
                                         double min_incidence_cos);

}  // namespace facet_mapping
