// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset_views.h"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "image_size.h"
#include "text_tables.h"

namespace facet_mapping {
namespace {

// MVSNet's training cameras, made for a quarter of the image size, lie 0.18 off the centre.
bool is_off_center(double principal_point, int size) {
  constexpr double kMostOffset = 0.15;
  return std::abs((principal_point + 0.5) / size - 0.5) > kMostOffset;
}

}  // namespace

FrameFolders view_folders(const std::string& folder) {
  FrameFolders folders;
  folders.labels = first_folder(folder, {"segmentation", "labels"});
  folders.gt_labels = first_folder(folder, {"labels_gt", "gt_label", "gt_labels"});
  folders.gt_depth = first_folder(folder, {"depth_gt", "gt_depth"});
  return folders;
}

void find_view_files(const FrameFolders& folders, const std::string& name, DatasetFrame& frame) {
  frame.labels = find_image(folders.labels, name);
  frame.gt_labels = find_image(folders.gt_labels, name);
  frame.gt_depth = find_image(folders.gt_depth, name);
}

double read_depth_scale(const FrameFolders& folders, double otherwise, Problems& problems) {
  const std::string path = folders.gt_depth + "/scale.txt";
  std::error_code error;
  if (folders.gt_depth.empty() || (otherwise > 0.0 && !std::filesystem::exists(path, error))) {
    return otherwise > 0.0 ? otherwise : 1.0;
  }
  if (!std::filesystem::exists(path, error)) {
    problems.add_missing(path +
                         " (one number: units of the depth images per unit of the poses' frame)");
    return 1.0;
  }
  const auto rows = read_rows(path, 1, problems);
  if (rows.size() != 1 || !(rows.front().front() > 0.0)) {
    problems.add(path + " must hold one number above 0");
    return 1.0;
  }
  return rows.front().front();
}

PinholeCamera camera_from_matrix(const Eigen::Matrix3d& intrinsics,
                                 const std::string& source,
                                 Problems& problems) {
  constexpr double kMostSkew = 0.05;  // pixels
  PinholeCamera camera;
  camera.fx = intrinsics(0, 0);
  camera.fy = intrinsics(1, 1);
  camera.cx = intrinsics(0, 2);
  camera.cy = intrinsics(1, 2);
  const bool is_pinhole =
      intrinsics(1, 0) == 0.0 && intrinsics.row(2).isApprox(Eigen::RowVector3d(0.0, 0.0, 1.0));
  if (!is_pinhole || !(camera.fx > 0.0 && camera.fy > 0.0)) {
    problems.add(source +
                 ": the camera matrix must be fx 0 cx / 0 fy cy / 0 0 1 with positive focal "
                 "lengths");
  } else if (!(std::abs(intrinsics(0, 1)) <= kMostSkew)) {
    problems.add(source + ": the camera matrix has a skew of " + std::to_string(intrinsics(0, 1)) +
                 " pixels; only cameras without skew can be used");
  } else {
    return camera;
  }
  return {};
}

void set_size_of_image(const std::string& source, DatasetFrame& frame, Problems& problems) {
  try {
    const cv::Size size = read_image_size(frame.left_image);
    PinholeCamera& camera = frame.view.camera;
    camera.width = size.width;
    camera.height = size.height;
    const bool is_known = camera.fx > 0.0;  // else a problem of its own
    if (is_known && is_off_center(camera.cx, size.width) && is_off_center(camera.cy, size.height)) {
      std::ostringstream sentence;
      sentence << source << ": the principal point " << camera.cx << " " << camera.cy
               << " lies far from the centre of the image, which has " << size.width << "x"
               << size.height << " pixels; the camera must be that of images of this size";
      problems.add(sentence.str());
    }
  } catch (const std::runtime_error& error) {
    problems.add(error.what());
  }
}

}  // namespace facet_mapping
