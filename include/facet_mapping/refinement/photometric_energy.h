// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The photometric energy and its gradient in the vertex positions (Romanoni et al. 2017, Eq. 3;
// Vu et al. 2012; Pons et al. 2007).
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/spline_image.h"
#include "facet_mapping/refinement/surface_view.h"
#include "facet_mapping/refinement/vertex_field.h"
#include "facet_mapping/refinement/zncc.h"

namespace facet_mapping {

/// A view's image, prepared once per pyramid level.
struct PhotometricView {
  View view;
  SplineImage image;
  cv::Mat reference;  ///< CV_32FC1: the spline at the pixel centres
  WindowStats stats;  ///< of `reference`
};

PhotometricView make_photometric_view(const View& view, const cv::Mat& gray, int window_px);

/// View j seen from view i through the mesh. All images have the size of view i.
struct WarpedImage {
  cv::Mat warped;  ///< CV_32FC1: J'(u) = I_j(P_j(x)), x the surface point at pixel u of view i
  cv::Mat flow;    ///< CV_32FC1: change of J'(u) per metre that the surface moves along its normal
  cv::Mat valid;   ///< CV_8UC1: 255 where x is seen and trusted in both views
};

WarpedImage warp_image(const TriangleMesh& mesh,
                       const std::vector<Eigen::Vector3d>& normals,
                       const View& view,
                       const SurfaceView& surface,
                       const PhotometricView& partner,
                       const SurfaceView& partner_surface);

struct PhotometricEnergy {
  double sum = 0.0;                        ///< of r (1 - zncc) over the counted pixels of all pairs
  std::size_t pixels = 0;                  ///< counted pixels of all pairs
  VertexField field;                       ///< of `sum`; empty unless asked for
  std::vector<std::vector<cv::Mat>> maps;  ///< ZnccResult::map of each view i and partner of i

  double mean() const { return pixels > 0 ? sum / static_cast<double>(pixels) : 0.0; }
};

/// By how much the mean energy rises from one shape to another, over the pixels that count in both:
/// what only one of them hides or shows is neither a gain nor a loss. 0 without such pixels.
/// Throws std::invalid_argument unless both are of the same views and partners.
double mean_change(const PhotometricEnergy& from, const PhotometricEnergy& to);

/// E = sum over ordered pairs (i, j in partners[i]) and pixels of r (1 - zncc), and
///   dE/dX_k = sum_u dE/dJ'(u) [grad I_j(P_j(x)) . DP_j(x) d] phi_k(x) / (n . d) n
/// with d = x - c_i, since the surface point at a fixed pixel moves by d (n . v) / (n . d).
/// The masks are held fixed: which pixels count is no force.
PhotometricEnergy photometric_energy(const TriangleMesh& mesh,
                                     const std::vector<PhotometricView>& views,
                                     const std::vector<SurfaceView>& surfaces,
                                     const std::vector<std::vector<int>>& partners,
                                     const ZnccConfig& config,
                                     bool with_gradient);

}  // namespace facet_mapping
