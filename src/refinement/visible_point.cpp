// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/visible_point.h"

namespace facet_mapping {
namespace {

/// Slack of the depth test in pixel footprints (metres per pixel at that depth).
constexpr double kSlackPx = 3.0;

double interpolate(const cv::Mat& depth, double x, double y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const double tx = x - column;
  const double ty = y - row;
  const float* upper = depth.ptr<float>(row) + column;
  const float* lower = depth.ptr<float>(row + 1) + column;
  return (1.0 - ty) * ((1.0 - tx) * upper[0] + tx * upper[1]) +
         ty * ((1.0 - tx) * lower[0] + tx * lower[1]);
}

}  // namespace

VisiblePoint::VisiblePoint(const View& view, const SurfaceView& surface)
    : camera_(view.camera), surface_(surface), cam_from_world_(view.cam_from_world()) {}

std::optional<Eigen::Vector3d> VisiblePoint::in_camera(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d point_in_cam = cam_from_world_ * point;
  return sees(point_in_cam) ? std::optional<Eigen::Vector3d>(point_in_cam) : std::nullopt;
}

bool VisiblePoint::sees(const Eigen::Vector3d& point_in_cam) const {
  constexpr double kBorderPx = 2.0;
  if (!(point_in_cam.z() > 0.0)) {
    return false;
  }
  const Eigen::Vector2d pixel = camera_.project(point_in_cam);
  if (!camera_.contains(pixel, kBorderPx)) {
    return false;
  }
  const int column = static_cast<int>(pixel.x() + 0.5);
  const int row = static_cast<int>(pixel.y() + 0.5);
  if (surface_.sampled.at<std::uint8_t>(row, column) == 0) {
    return false;
  }
  const double depth = interpolate(surface_.image.depth, pixel.x(), pixel.y());
  const double footprint = point_in_cam.z() / camera_.fx;
  return point_in_cam.z() <= depth + kSlackPx * footprint;
}

}  // namespace facet_mapping
