// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// KITTI odometry: image_2/, image_3/ (or image_0/, image_1/), calib.txt with P0..P3 and Tr.
#include <filesystem>

#include "calib_file.h"
#include "dataset_cameras.h"
#include "dataset_files.h"
#include "dataset_layouts.h"
#include "text_tables.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

struct Pair {
  std::string left;
  std::string right;
};

Pair camera_pair(const std::string& folder) {
  return first_folder(folder, {"image_2"}).empty() ? Pair{"0", "1"} : Pair{"2", "3"};
}

FrameFolders folders_in(const std::string& folder, const Pair& pair) {
  FrameFolders folders;
  folders.left = folder + "/image_" + pair.left;
  folders.right = first_folder(folder, {"image_" + pair.right});
  folders.labels = first_folder(folder, {"labels", "image_" + pair.left + "/labels"});
  folders.gt_labels = first_folder(folder, {"gt_label", "gt_labels"});
  folders.gt_depth = first_folder(folder, {"gt_depth"});
  folders.scans = first_folder(folder, {"velodyne"});
  return folders;
}

// The benchmark keeps the poses of sequences/NN in poses/NN.txt.
std::string poses_path(const std::string& folder) {
  std::error_code error;
  const fs::path own = fs::path(folder) / "poses.txt";
  fs::path here = fs::weakly_canonical(folder, error);
  if (here.filename().empty()) {
    here = here.parent_path();
  }
  const fs::path shared =
      here.parent_path().parent_path() / "poses" / (here.filename().string() + ".txt");
  return (!fs::exists(own, error) && fs::exists(shared, error) ? shared : own).string();
}

// The camera that the images come from is not the one of the poses (camera 0), but stands beside
// it.
std::vector<Eigen::Isometry3d> move_to(const RigCamera& camera,
                                       std::vector<Eigen::Isometry3d> poses) {
  for (Eigen::Isometry3d& pose : poses) {
    pose = camera.cam_from_rig * pose * camera.cam_from_rig.inverse(Eigen::Isometry);
  }
  return poses;
}

void read_calibration(const std::string& path,
                      const Pair& pair,
                      const std::vector<Eigen::Isometry3d>& poses,
                      Dataset& dataset,
                      Problems& problems) {
  const CalibFile calib(path, problems);
  const auto left = read_rig_camera(calib, "P" + pair.left);
  const auto right = dataset.has_right ? read_rig_camera(calib, "P" + pair.right) : std::nullopt;
  const auto rig_from_velo = dataset.has_scans ? calib.transform("Tr") : std::nullopt;
  if (!left) {
    return;
  }
  set_camera(left->intrinsics, path, dataset, problems);
  set_poses(move_to(*left, poses), dataset);
  if (right) {
    set_right(*left, *right, path, dataset, problems);
  }
  if (rig_from_velo) {
    dataset.left_from_velo = left->cam_from_rig * *rig_from_velo;
  }
}

}  // namespace

Dataset read_kitti_odometry(const std::string& folder, Problems& problems) {
  Dataset dataset;
  dataset.is_z_up = true;
  const Pair pair = camera_pair(folder);
  const std::vector<double> times = read_times(folder + "/times.txt", problems);
  const std::vector<Eigen::Isometry3d> poses = read_poses(poses_path(folder), problems);
  dataset.frames.resize(poses.size());
  const FrameFolders folders = folders_in(folder, pair);
  find_files(folders,
             frame_names(folders.left, poses.size(), poses_path(folder), problems),
             dataset,
             problems);
  read_calibration(folder + "/calib.txt", pair, poses, dataset, problems);
  set_stamps(times, folder + "/times.txt", dataset, problems);
  return dataset;
}

}  // namespace facet_mapping
