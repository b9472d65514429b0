// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of posed images: what kitti_to_bag, evaluate_mesh and refine_mesh read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// One instant of a dataset. Paths are empty where the folder has no such file. KITTI poses are in
/// a map frame with z up (REP-103: the first camera, x forward, y left), Strecha poses as given.
struct DatasetFrame {
  double stamp = 0.0;  ///< seconds
  View view;           ///< left (or only) camera
  std::string left_image;
  std::string right_image;
  std::string labels;     ///< segmentation input, 8-bit ids
  std::string gt_labels;  ///< ground-truth ids, 255 = none
  std::string gt_depth;   ///< 16-bit PNG, see depth_scale
  std::string scan;       ///< velodyne .bin
};

struct Dataset {
  std::vector<DatasetFrame> frames;
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d left_from_velo = Eigen::Isometry3d::Identity();
  bool has_right = false;
  bool has_scans = false;
  double depth_scale = 256.0;  ///< PNG units per metre
  double baseline_m() const { return -right_from_left.translation().x(); }
};

/// Finds out the layout (see README) and reads everything but the images. Throws
/// std::runtime_error listing every missing or broken file with what was expected.
Dataset read_dataset(const std::string& folder);

/// Reads a depth PNG into CV_32F metres, 0 = none. Throws std::runtime_error.
cv::Mat read_depth(const std::string& path, double scale);

/// Reads float32 x y z intensity records, velodyne frame. Throws std::runtime_error on a file whose
/// size is no multiple of 16 bytes.
std::vector<Eigen::Vector4f> read_scan(const std::string& path);

}  // namespace facet_mapping
