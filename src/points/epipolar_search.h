// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A pixel's match on its epipolar line in another image.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping::detail {

/// Where a pixel of one image can be in another: a curve over the inverse depth.
class EpipolarLine {
 public:
  EpipolarLine(const View& from, const View& to, const Eigen::Vector2d& pixel);

  /// z in the other camera over z in the first one; positive where the point is in front of both.
  double depth_ratio(double inverse_depth) const {
    return direction_.z() + inverse_depth * shift_.z();
  }
  Eigen::Vector2d pixel(double inverse_depth) const;
  /// d(pixel) / d(inverse depth): points along the line.
  Eigen::Vector2d pixel_rate(double inverse_depth) const;
  /// Distance of a pixel from the line, pixels; from the line's only point if there is no motion.
  double distance(const Eigen::Vector2d& pixel) const;

 private:
  PinholeCamera camera_;
  Eigen::Vector3d direction_;  // the ray (z = 1) in the other camera's frame
  Eigen::Vector3d shift_;      // the first camera's centre there
};

struct InverseDepthRange {
  double low = 0.0;
  double high = 0.0;
};

struct EpipolarMatch {
  enum class Kind { kFound, kNone, kAmbiguous };
  Kind kind = Kind::kNone;
  double inverse_depth = 0.0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double likeness = 0.0;
};

struct EpipolarSearchConfig {
  int patch_radius_px = 4;
  double min_likeness = 0.8;
  double min_uniqueness = 0.05;
};

/// The place of greatest normalised cross-correlation with the patch around `pixel` of `gray_from`,
/// which is scaled as a surface that faces the camera would be. Indifferent to exposure.
EpipolarMatch search_epipolar(const cv::Mat& gray_from,
                              const Eigen::Vector2d& pixel,
                              const cv::Mat& gray_to,
                              const EpipolarLine& line,
                              const PinholeCamera& camera_to,
                              const InverseDepthRange& range,
                              const EpipolarSearchConfig& config);

}  // namespace facet_mapping::detail
