// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of posed images: what kitti_to_bag, evaluate_mesh and refine_mesh read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// One instant of a dataset. Paths are empty where the folder has no such file. KITTI poses are in
/// a map frame with z up (REP-103: the first left camera, x forward, y left), poses of the other
/// layouts as given.
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
  bool is_z_up = false;        ///< the poses' frame is a REP-103 map (all KITTI layouts)
  double depth_scale = 256.0;  ///< PNG units per metre (per unit of the poses, if not metric)
  double epoch = 0.0;          ///< Unix time of stamp 0, seconds; 0 = the folder does not say
  double baseline_m() const { return -right_from_left.translation().x(); }
};

/// Finds out the layout and reads everything but the images (of these only the first, for the
/// size; where each has its own camera, the size of each). Layouts, told apart by the file in
/// front:
///  - left/: left/ [right/ labels/ gt_label/ gt_depth/ velodyne/] calib.txt (K, T_right_left,
///    T_left_velo, baseline_m), poses.txt (world_from_left, first camera), times.txt;
///  - image_2/ (or image_0/): KITTI odometry, calib.txt (P0..P3, Tr), times.txt, poses.txt or
///    ../../poses/NN.txt, [image_3/ velodyne/ labels/ gt_label/ gt_depth/];
///  - image_02/ (or image_00/): KITTI raw drive, oxts/, [image_03/ velodyne_points/ labels/ or
///    image_02/labels/], calib_*.txt in the parent folder; poses from GPS/IMU by the Mercator
///    projection;
///  - cameras.json: Strecha, images/ [depth_gt/ (0.5 mm units) labels_gt/ segmentation/];
///  - sparse/0/, sparse/ or the folder itself with cameras.txt and images.txt: COLMAP text model,
///    images/ of the model's size [depth_gt/ with units of 1/2000 of the model's or those in
///    depth_gt/scale.txt]; frames are ordered by image name, subfolders of images/ are those of the
///    other folders too. Cameras must be pinholes (of models with distortion those whose
///    coefficients are zero); COLMAP's pixel centres at halves become ours at integers;
///  - cams/ (or cams_1/) with 00000000_cam.txt ...: MVSNet and DTU prepared for it, images/ (or
///    blended_images/) 00000000.jpg ..., a camera for each image of the images' own size, pixel
///    centres at integers (cameras that colmap2mvsnet.py wrote are half a pixel off: give the
///    COLMAP model instead); [depth_gt/ with scale.txt];
///  - rect_001_max.png ... or rect_001_3_r5000.png ... here or in images/ (of one light: the one
///    that more positions have, else max): DTU as published; 3x4 projection matrices pos_001.txt
///    ... in cal18/, calib/ or Calibration/cal18/ here or in the two folders above (positions
///    without image are left out), pixel centres at integers; [depth_gt/ with scale.txt].
/// The last four have single images: labels are also found in segmentation/ or labels/, ground
/// truth in labels_gt/ or gt_label/ and depth_gt/ or gt_depth/ by the image's name; the stamp is
/// the view's index; lengths are in the units of the folder (DTU: millimetres). Left and right
/// images, poses and times must be complete; segmentation, ground truth and scans may miss frames.
/// Throws std::runtime_error listing every missing or broken file with what was expected.
Dataset read_dataset(const std::string& folder);

/// The layouts and what tells them, a line each: for the help of programs.
std::string dataset_layouts_help();

/// One past the last of the frames `first` .. `last` (this one included, if there is one) that the
/// dataset has. Throws std::invalid_argument if it has none of them.
std::size_t end_frame(const Dataset& dataset, std::size_t first, std::size_t last);

/// CV_8UC1 / CV_8UC3 (BGR) image. Both throw std::runtime_error on a missing, truncated or foreign
/// file.
cv::Mat read_gray(const std::string& path);
cv::Mat read_color(const std::string& path);

/// Class ids as CV_16UC1 from an 8-bit or 16-bit single-channel image; 255 of 8-bit images ("void"
/// of Cityscapes, "none" of ground truth) becomes kUnlabelled. Throws std::runtime_error.
cv::Mat read_labels(const std::string& path);

/// Reads a depth PNG into CV_32F metres, 0 = none. Throws std::runtime_error.
cv::Mat read_depth(const std::string& path, double scale);

/// Reads float32 x y z intensity records, velodyne frame. Throws std::runtime_error on an empty
/// file or one whose size is no multiple of 16 bytes.
std::vector<Eigen::Vector4f> read_scan(const std::string& path);

}  // namespace facet_mapping
