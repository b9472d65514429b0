// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Off-screen rendering of facet ids and depth, without a display or a GPU.
#pragma once

#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// Surface nearer than this (camera z, metres) is cut away exactly.
constexpr double kNearDepth = 1e-3;

/// What a camera sees of a mesh. Both images have the camera's size.
struct FacetImage {
  cv::Mat facets;  ///< CV_32SC1: facet index, -1 where nothing is seen
  cv::Mat depth;   ///< CV_32FC1: planar depth (camera z) in metres, 0 where nothing is seen
};

enum class RenderBackend {
  kSoftware,  ///< own z-buffer rasteriser: no global state, exact clipping, runs in parallel
  kOsmesa,    ///< Mesa's off-screen OpenGL: the reference
};

/// Pixels are sampled at their centres (integer coordinates); both sides of a facet are drawn; of
/// facets at equal depth the one with the smaller index is seen. The software backend's image is
/// the same whatever the number of threads. One object serves one thread at a time; separate
/// objects may be used at once.
class FacetRenderer {
 public:
  FacetRenderer() = default;
  FacetRenderer(const FacetRenderer&) = delete;
  FacetRenderer& operator=(const FacetRenderer&) = delete;
  virtual ~FacetRenderer() = default;
  /// Throws std::invalid_argument if the camera or the pose is invalid, a facet names a vertex that
  /// is not there or a vertex is not finite.
  virtual FacetImage render(const TriangleMesh& mesh, const View& view) = 0;
};

/// Throws std::runtime_error with the reason where the backend cannot start (OSMesa without a
/// driver that knows gl_PrimitiveID).
std::unique_ptr<FacetRenderer> make_renderer(RenderBackend backend = RenderBackend::kSoftware);

/// CV_16UC1 class image of a rendering: facet labels, kUnlabelled where nothing is seen or the mesh
/// has no labels. Throws std::invalid_argument if the rendering names a facet the mesh has not.
cv::Mat label_image(const FacetImage& image, const TriangleMesh& mesh);

}  // namespace facet_mapping
