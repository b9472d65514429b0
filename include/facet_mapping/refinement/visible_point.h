// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Is a surface point seen by a partner view, where its image may be sampled?
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/refinement/surface_view.h"

namespace facet_mapping {

/// The depth test of photometry. Unlike the test of the labelling it interpolates the rendered
/// depth, so that a slanted surface never hides itself, and its slack is counted in pixels.
class VisiblePoint {
 public:
  /// Both arguments must outlive the object.
  VisiblePoint(const View& view, const SurfaceView& surface);

  /// The point (map frame) in the camera frame if it is seen, at least two pixels inside the image
  /// and away from depth jumps.
  std::optional<Eigen::Vector3d> in_camera(const Eigen::Vector3d& point) const;

  /// The same for a point that is already in the camera frame.
  bool sees(const Eigen::Vector3d& point_in_cam) const;

 private:
  const PinholeCamera& camera_;
  const SurfaceView& surface_;
  Eigen::Isometry3d cam_from_world_;
};

}  // namespace facet_mapping
