// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// COLMAP's text model (colmap.github.io/format.html): cameras.txt and images.txt.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "problems.h"
#include <Eigen/Geometry>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

/// Cameras by CAMERA_ID, pixel centres moved from COLMAP's halves to integers. A wrong row, a model
/// with distortion and an id that occurs twice are added to the problems (the camera stays in the
/// map, is_valid() is false).
std::map<std::string, PinholeCamera> read_colmap_cameras(const std::string& path,
                                                         Problems& problems);

struct ColmapImage {
  std::string name;  ///< relative to the folder of images, may lie in a subfolder
  std::string camera_id;
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
};

/// The images, ordered by name. A wrong row, a name that occurs twice and another number of images
/// than the header says are added to the problems.
std::vector<ColmapImage> read_colmap_images(const std::string& path, Problems& problems);

}  // namespace facet_mapping
