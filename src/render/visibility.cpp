// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/render/visibility.h"

#include <cmath>
#include <stdexcept>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

VisibilityTest::VisibilityTest(const View& view, const cv::Mat& depth, double relative_tolerance)
    : camera_(view.camera),
      cam_from_world_(view.cam_from_world()),
      depth_(depth),
      relative_tolerance_(relative_tolerance) {
  if (!camera_.is_valid() || depth.type() != CV_32FC1 || depth.cols != camera_.width ||
      depth.rows != camera_.height) {
    throw std::invalid_argument(
        "visibility: give a valid camera and a CV_32FC1 depth image of its size");
  }
  if (!is_rigid(view.world_from_cam)) {
    throw std::invalid_argument("visibility: the pose of the view is not a rigid transform");
  }
  if (!std::isfinite(relative_tolerance) || relative_tolerance < 0.0) {
    throw std::invalid_argument("visibility: the depth tolerance must be zero or positive");
  }
}

std::optional<cv::Point> VisibilityTest::pixel(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d in_cam = cam_from_world_ * point;
  const double z = in_cam.z();
  if (!(z >= kNearDepth)) {
    return std::nullopt;
  }
  const Eigen::Vector2d position = camera_.project(in_cam);
  // Written so that a position that is not a number fails as well.
  if (!camera_.contains(position, -0.499)) {
    return std::nullopt;
  }
  const cv::Point nearest(static_cast<int>(std::lround(position.x())),
                          static_cast<int>(std::lround(position.y())));
  const double seen = depth_.at<float>(nearest);
  if (seen <= 0.0 || std::abs(seen - z) > relative_tolerance_ * z) {
    return std::nullopt;
  }
  return nearest;
}

bool visible_in(const View& view,
                const cv::Mat& depth,
                const Eigen::Vector3d& point,
                double relative_tolerance) {
  return VisibilityTest(view, depth, relative_tolerance).pixel(point).has_value();
}

}  // namespace facet_mapping
