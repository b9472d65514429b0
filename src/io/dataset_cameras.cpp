// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset_cameras.h"

#include <algorithm>
#include <stdexcept>

namespace facet_mapping {
namespace {

// The first image that is there; a missing one is a problem of its own.
std::string any_image(const Dataset& dataset) {
  for (const DatasetFrame& frame : dataset.frames) {
    if (!frame.left_image.empty()) {
      return frame.left_image;
    }
  }
  return "";
}

PinholeCamera camera_from(const Eigen::Matrix3d& intrinsics, const cv::Mat& image) {
  PinholeCamera camera;
  camera.width = image.cols;
  camera.height = image.rows;
  camera.fx = intrinsics(0, 0);
  camera.fy = intrinsics(1, 1);
  camera.cx = intrinsics(0, 2);
  camera.cy = intrinsics(1, 2);
  return camera;
}

}  // namespace

std::optional<RigCamera> read_rig_camera(const CalibFile& calib, const std::string& key) {
  const auto projection = calib.matrix34(key);
  if (!projection) {
    return std::nullopt;
  }
  RigCamera camera;
  camera.intrinsics = projection->leftCols<3>();
  camera.cam_from_rig.translation() = camera.intrinsics.inverse() * projection->col(3);
  return camera;
}

void set_right(const RigCamera& left,
               const RigCamera& right,
               const std::string& source,
               Dataset& dataset,
               Problems& problems) {
  constexpr double kSameK = 1e-3;  // pixels
  if (!left.intrinsics.isApprox(right.intrinsics, kSameK / left.intrinsics.norm())) {
    problems.add(source + ": left and right camera matrix differ; rectified images have the same");
  }
  dataset.right_from_left = right.cam_from_rig * left.cam_from_rig.inverse(Eigen::Isometry);
  check_baseline(dataset, source, problems);
}

void check_baseline(const Dataset& dataset, const std::string& source, Problems& problems) {
  if (!(dataset.baseline_m() > 0.0)) {
    problems.add(source +
                 ": the right camera stands at x = " + std::to_string(dataset.baseline_m()) +
                 " m of the left one, but it must stand at positive x (swapped?)");
  }
}

void set_camera(const Eigen::Matrix3d& intrinsics,
                const std::string& source,
                Dataset& dataset,
                Problems& problems) {
  const std::string path = any_image(dataset);
  if (path.empty()) {
    return;
  }
  try {
    const PinholeCamera camera = camera_from(intrinsics, read_gray(path));
    if (!camera.is_valid() || intrinsics(0, 1) != 0.0) {
      problems.add(source + ": the camera matrix needs positive focal lengths and no skew");
    }
    for (DatasetFrame& frame : dataset.frames) {
      frame.view.camera = camera;
    }
  } catch (const std::runtime_error& error) {
    problems.add(error.what());
  }
}

void set_poses(const std::vector<Eigen::Isometry3d>& first_from_cam, Dataset& dataset) {
  Eigen::Isometry3d map_from_first = Eigen::Isometry3d::Identity();
  map_from_first.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  for (std::size_t k = 0; k < std::min(first_from_cam.size(), dataset.frames.size()); ++k) {
    dataset.frames[k].view.world_from_cam = map_from_first * first_from_cam[k];
  }
}

void set_stamps(const std::vector<double>& times,
                const std::string& source,
                Dataset& dataset,
                Problems& problems) {
  if (!times.empty() && times.size() != dataset.frames.size()) {
    problems.add(source + " has " + std::to_string(times.size()) + " times for " +
                 std::to_string(dataset.frames.size()) + " frames");
  }
  for (std::size_t k = 0; k < std::min(times.size(), dataset.frames.size()); ++k) {
    dataset.frames[k].stamp = times[k];
  }
}

}  // namespace facet_mapping
