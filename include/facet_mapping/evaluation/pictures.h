// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a rendered mesh for people. All are CV_8UC3 (BGR) of the rendering's size; where
// nothing is seen they are white. Each throws std::invalid_argument on images that do not fit each
// other.
#pragma once

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

/// Class colours, unlabelled facets grey.
cv::Mat label_picture(const FacetImage& image, const TriangleMesh& mesh, const LabelSet& labels);

/// The range of depths that a picture's colours span, metres.
struct DepthRange {
  double near_m = 0.0;
  double far_m = 0.0;
};

/// From the 1st to the 99th percentile of the depths, {0, 1} for an empty image.
DepthRange depth_range(const cv::Mat& depth);

/// Red is near, blue is far, evenly in the logarithm of the depth.
cv::Mat depth_picture(const cv::Mat& depth, const DepthRange& range);

/// Unit normals in the map frame, turned to the camera, as red = x, green = y, blue = z from -1
/// to 1.
cv::Mat normal_picture(const FacetImage& image, const TriangleMesh& mesh, const View& view);

/// Class colours (ivory for a mesh without labels) in light from above the camera's left shoulder,
/// darkened in hollows.
cv::Mat shaded_picture(const FacetImage& image,
                       const TriangleMesh& mesh,
                       const LabelSet& labels,
                       const View& view);

/// |rendered - true| depth from blue (none) to red (`max_error_m` and more), magenta where there is
/// ground truth but no mesh, on a pale copy of `background`. Pixels of sparse ground truth are
/// enlarged.
cv::Mat error_picture(const cv::Mat& rendered,
                      const cv::Mat& truth,
                      double max_error_m,
                      const cv::Mat& background);

/// `opacity` 0..1 of the class colours over the camera's image where a labelled facet is seen.
cv::Mat overlay_picture(const cv::Mat& camera_image,
                        const FacetImage& image,
                        const TriangleMesh& mesh,
                        const LabelSet& labels,
                        double opacity);

}  // namespace facet_mapping
