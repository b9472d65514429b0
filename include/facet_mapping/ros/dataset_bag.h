// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A dataset folder as a bag, as if its drive had been recorded.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {

struct DatasetBagOptions {
  std::string topic_prefix = "/kitti";  ///< all topics but /tf and /tf_static begin with it
  bool with_right = true;               ///< the right camera's images and camera_info
  bool with_scans = true;               ///< LiDAR
  bool with_labels = true;              ///< segmentation
  std::size_t first_frame = 0;
  std::size_t last_frame = std::numeric_limits<std::size_t>::max();  ///< this one is written, too
  double epoch = 1316995200.0;  ///< Unix time of stamp 0 where the dataset has none: 2011-09-26
};

struct DatasetBagReport {
  std::size_t frames = 0;
  std::size_t messages = 0;
  std::size_t scans = 0;
  std::size_t label_images = 0;
};

/// Called after each frame.
using BagProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Writes, for each frame at its stamp (prefix /kitti):
///  - /kitti/camera_color_left/image_raw (bgr8) and camera_info; camera_color_right/ likewise, with
///    P(0,3) = -fx * baseline. Images are rectified: D is zero, R the identity;
///  - /kitti/camera_color_left/segmentation: class ids, mono8 (mono16 if an id needs it, 255 or
///  65535 =
///    none); /kitti/velo/pointcloud: x y z intensity; where the frame has them;
///  - /tf: map -> base_link; once, latched, /tf_static: base_link -> camera_color_left ->
///    {camera_color_right, velo_link}. Camera frames are optical; base_link stands at the left
///    camera, x forward, y left, z up.
/// The bag appears under its name only when it is complete. Throws std::invalid_argument if no
/// frame lies in the range, std::runtime_error on broken files or a disk that is full.
DatasetBagReport write_dataset_bag(const Dataset& dataset,
                                   const std::string& bag_path,
                                   const DatasetBagOptions& options = {},
                                   const BagProgress& progress = {});

}  // namespace facet_mapping
