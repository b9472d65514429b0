// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras and poses of a dataset from calibration files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib_file.h"
#include "problems.h"

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {

/// A camera of a rectified rig, read from P = K [I | t].
struct RigCamera {
  Eigen::Matrix3d intrinsics = Eigen::Matrix3d::Identity();
  Eigen::Isometry3d cam_from_rig = Eigen::Isometry3d::Identity();
};

std::optional<RigCamera> read_rig_camera(const CalibFile& calib, const std::string& key);

/// Sets right_from_left. Problems: another K than the left camera's, no positive baseline.
void set_right(const RigCamera& left,
               const RigCamera& right,
               const std::string& source,
               Dataset& dataset,
               Problems& problems);

/// A rectified pair needs its right camera at positive x.
void check_baseline(const Dataset& dataset, const std::string& source, Problems& problems);

/// Sets the left camera of all frames, with the size of the first image. Problems: an image that
/// cannot be read, a camera matrix with skew or without focal length.
void set_camera(const Eigen::Matrix3d& intrinsics,
                const std::string& source,
                Dataset& dataset,
                Problems& problems);

/// Turns poses in the frame of the first (optical) camera to a map frame with z up and sets them.
void set_poses(const std::vector<Eigen::Isometry3d>& first_from_cam, Dataset& dataset);

/// Sets the stamps; another number than that of the frames is a problem.
void set_stamps(const std::vector<double>& times,
                const std::string& source,
                Dataset& dataset,
                Problems& problems);

}  // namespace facet_mapping
