// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/picture_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace facet_mapping {

View look_at(const Eigen::Vector3d& eye,
             const Eigen::Vector3d& target,
             const Eigen::Vector3d& up,
             const cv::Size& size,
             double fov_deg) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  constexpr double kSmallest = 1e-9;
  if (!((target - eye).norm() > kSmallest) || !(forward.cross(up).norm() > kSmallest)) {
    throw std::invalid_argument(
        "the eye must stand apart from the target and not exactly above or below it");
  }
  if (size.width <= 0 || size.height <= 0 || !(fov_deg > 0.0 && fov_deg < 180.0)) {
    throw std::invalid_argument(
        "a picture needs a positive size and a field of view between 0 and 180 degrees");
  }
  View view;
  view.world_from_cam.linear() << right, forward.cross(right), forward;
  view.world_from_cam.translation() = eye;
  const double focal = size.width / 2.0 / std::tan(fov_deg * M_PI / 360.0);
  view.camera = {
      size.width, size.height, focal, focal, (size.width - 1) / 2.0, (size.height - 1) / 2.0};
  return view;
}

View bird_view(const Dataset& dataset, const cv::Size& size, double fov_deg) {
  if (dataset.frames.empty()) {
    throw std::invalid_argument("a bird's view needs a dataset with frames");
  }
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  Eigen::Vector3d ahead = Eigen::Vector3d::Zero();
  for (const DatasetFrame& frame : dataset.frames) {
    up -= frame.view.world_from_cam.linear().col(1);
    ahead += frame.view.world_from_cam.linear().col(2);
  }
  up = dataset.is_z_up ? Eigen::Vector3d::UnitZ() : up.normalized();
  ahead = (ahead - ahead.dot(up) * up).normalized();
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const DatasetFrame& frame : dataset.frames) {
    first = std::min(first, frame.view.center().dot(ahead));
    last = std::max(last, frame.view.center().dot(ahead));
    mean += frame.view.center() / static_cast<double>(dataset.frames.size());
  }
  const double length = last - first;
  const Eigen::Vector3d start = mean + (first - mean.dot(ahead)) * ahead;
  const Eigen::Vector3d eye = start - (0.4 * length + 8.0) * ahead + (0.35 * length + 6.0) * up;
  const Eigen::Vector3d target = start + (0.4 * length + 4.0) * ahead;
  return look_at(eye, target, up, size, fov_deg);
}

}  // namespace facet_mapping
