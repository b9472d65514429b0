// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does a camera see a point of the map? The test by rendered depth.
#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

/// The test for many points of one view: the pose is inverted once.
class VisibilityTest {
 public:
  /// `depth`: FacetImage::depth rendered in `view` (shared, not copied).
  /// Throws std::invalid_argument if it is not CV_32FC1 of the camera's size, the camera or the
  /// pose is invalid, or the tolerance is negative or not finite.
  VisibilityTest(const View& view, const cv::Mat& depth, double relative_tolerance);

  /// The pixel nearest to the projection of `point` (map frame, metres), if the point lies in front
  /// of the camera, that pixel inside the image, and the rendered depth there differs from the
  /// point's by at most `relative_tolerance` times the point's. Pixels showing nothing see nothing.
  std::optional<cv::Point> pixel(const Eigen::Vector3d& point) const;

 private:
  PinholeCamera camera_;
  Eigen::Isometry3d cam_from_world_;
  cv::Mat depth_;
  double relative_tolerance_;
};

/// One point: VisibilityTest(view, depth, relative_tolerance).pixel(point) is there.
bool visible_in(const View& view,
                const cv::Mat& depth,
                const Eigen::Vector3d& point,
                double relative_tolerance);

}  // namespace facet_mapping
