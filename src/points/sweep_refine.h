// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refinement of single depths on the images at full size.
#pragma once

#include <vector>

#include "sweep_image.h"

namespace facet_mapping::detail {

/// A small piece of surface about a pixel: its inverse depth there and the change per pixel.
struct SurfacePatch {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // at full size
  double inverse_depth = 0.0;                       // 1/m
  Eigen::Vector2d slant = Eigen::Vector2d::Zero();  // 1/m per pixel
};

struct RefinedDepth {
  double inverse_depth = 0.0;  // 1/m
  double precision = 0.0;      // pixels per 1/m, as depth_precision() has it, across the texture
  double likeness = 0.0;       // mean correlation with the images that see the patch
};

/// Least squares on the grey values of the patch in all images at once (Lucas & Kanade 1981, one
/// unknown; brightness and contrast of each image are free). Images in which the patch is hidden,
/// which look unlike it, are left out. Likeness 0 if fewer than half of those that have the pixel
/// are left.
RefinedDepth refine_depth(const SweepImage& reference,
                          const std::vector<const SweepImage*>& others,
                          const SurfacePatch& patch);

/// Slant at a pixel of an inverse depth map, per pixel of the map, from those around it that may
/// belong to the same surface (within `tolerance` of its plane).
Eigen::Vector2d measure_slant(const cv::Mat& inverse_depth, const cv::Point& at, double tolerance);

}  // namespace facet_mapping::detail
