// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// KITTI raw: a drive folder with image_02/data, image_03/data, oxts/data; calibration beside it.
#include <filesystem>

#include "calib_file.h"
#include "dataset_cameras.h"
#include "dataset_files.h"
#include "dataset_layouts.h"
#include "oxts.h"
#include "text_tables.h"
#include "timestamps.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

// Camera numbers as in the file names.
struct Pair {
  std::string left;
  std::string right;
};

Pair camera_pair(const std::string& folder) {
  return first_folder(folder, {"image_02"}).empty() ? Pair{"00", "01"} : Pair{"02", "03"};
}

FrameFolders folders_in(const std::string& folder, const Pair& pair) {
  FrameFolders folders;
  folders.left = folder + "/image_" + pair.left + "/data";
  folders.right = first_folder(folder, {"image_" + pair.right + "/data"});
  folders.labels = first_folder(folder, {"image_" + pair.left + "/labels", "labels"});
  folders.gt_labels = first_folder(folder, {"gt_label", "gt_labels"});
  folders.gt_depth =
      first_folder(folder, {"gt_depth", "proj_depth/groundtruth/image_" + pair.left});
  folders.scans = first_folder(folder, {"velodyne_points/data"});
  return folders;
}

// The calibration of a day lies beside its drives.
std::string calib_path(const std::string& folder, const std::string& name) {
  std::error_code error;
  const fs::path own = fs::path(folder) / name;
  const fs::path day = fs::weakly_canonical(folder, error).parent_path() / name;
  return (fs::exists(own, error) ? own : day).string();
}

struct Calibration {
  std::optional<RigCamera> left;
  std::optional<RigCamera> right;
  std::optional<Eigen::Isometry3d> left_from_velo;
  std::optional<Eigen::Isometry3d> left_from_imu;
};

Calibration read_calibration(const std::string& folder,
                             const Pair& pair,
                             bool has_right,
                             Problems& problems) {
  const CalibFile cameras(calib_path(folder, "calib_cam_to_cam.txt"), problems);
  const CalibFile velo(calib_path(folder, "calib_velo_to_cam.txt"), problems);
  const CalibFile imu(calib_path(folder, "calib_imu_to_velo.txt"), problems);
  Calibration calibration;
  calibration.left = read_rig_camera(cameras, "P_rect_" + pair.left);
  if (has_right) {
    calibration.right = read_rig_camera(cameras, "P_rect_" + pair.right);
  }
  const auto rectification = cameras.matrix3("R_rect_00");
  const auto camera_from_velo = velo.transform("R", "T");
  const auto velo_from_imu = imu.transform("R", "T");
  const auto rig_from_camera =
      rectification ? rigid_from(*rectification, Eigen::Vector3d::Zero()) : std::nullopt;
  if (rectification && !rig_from_camera) {
    problems.add(calib_path(folder, "calib_cam_to_cam.txt") + ": 'R_rect_00' is no rotation");
  }
  if (calibration.left && rig_from_camera && camera_from_velo) {
    calibration.left_from_velo =
        calibration.left->cam_from_rig * *rig_from_camera * *camera_from_velo;
  }
  if (calibration.left_from_velo && velo_from_imu) {
    calibration.left_from_imu = *calibration.left_from_velo * *velo_from_imu;
  }
  return calibration;
}

// Poses of the left camera in the frame of the first one.
std::vector<Eigen::Isometry3d> camera_poses(const std::vector<Eigen::Isometry3d>& world_from_imu,
                                            const Eigen::Isometry3d& cam_from_imu) {
  std::vector<Eigen::Isometry3d> poses;
  if (world_from_imu.empty()) {
    return poses;
  }
  const Eigen::Isometry3d imu_from_cam = cam_from_imu.inverse(Eigen::Isometry);
  const Eigen::Isometry3d first_from_world =
      cam_from_imu * world_from_imu.front().inverse(Eigen::Isometry);
  for (const Eigen::Isometry3d& pose : world_from_imu) {
    poses.push_back(first_from_world * pose * imu_from_cam);
  }
  return poses;
}

void apply(const Calibration& calibration,
           const std::string& source,
           const std::vector<Eigen::Isometry3d>& world_from_imu,
           Dataset& dataset,
           Problems& problems) {
  if (calibration.left) {
    set_camera(calibration.left->intrinsics, source, dataset, problems);
  }
  if (calibration.left && calibration.right) {
    set_right(*calibration.left, *calibration.right, source, dataset, problems);
  }
  if (calibration.left_from_velo) {
    dataset.left_from_velo = *calibration.left_from_velo;
  }
  if (calibration.left_from_imu) {
    set_poses(camera_poses(world_from_imu, *calibration.left_from_imu), dataset);
  }
}

}  // namespace

Dataset read_kitti_raw(const std::string& folder, Problems& problems) {
  Dataset dataset;
  dataset.is_z_up = true;
  const Pair pair = camera_pair(folder);
  const std::string times_path = folder + "/image_" + pair.left + "/timestamps.txt";
  const auto times = read_timestamps(times_path, dataset.epoch, problems);
  dataset.frames.resize(times.size());
  const FrameFolders folders = folders_in(folder, pair);
  const auto names = frame_names(folders.left, times.size(), times_path, problems);
  find_files(folders, names, dataset, problems);
  const auto world_from_imu = read_oxts(folder + "/oxts/data", names, problems);
  const Calibration calibration = read_calibration(folder, pair, dataset.has_right, problems);
  apply(calibration, calib_path(folder, "calib_cam_to_cam.txt"), world_from_imu, dataset, problems);
  set_stamps(times, times_path, dataset, problems);
  return dataset;
}

}  // namespace facet_mapping
