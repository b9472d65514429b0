// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// left/, right/ ... with calib.txt, poses.txt, times.txt.
#include <cmath>

#include "calib_file.h"
#include "dataset_cameras.h"
#include "dataset_files.h"
#include "dataset_layouts.h"
#include "text_tables.h"

namespace facet_mapping {
namespace {

FrameFolders folders_in(const std::string& folder) {
  FrameFolders folders;
  folders.left = folder + "/left";
  folders.right = first_folder(folder, {"right"});
  folders.labels = first_folder(folder, {"labels"});
  folders.gt_labels = first_folder(folder, {"gt_label", "gt_labels"});
  folders.gt_depth = first_folder(folder, {"gt_depth"});
  folders.scans = first_folder(folder, {"velodyne"});
  return folders;
}

void check_stated_baseline(const CalibFile& calib,
                           const std::string& source,
                           const Dataset& dataset,
                           Problems& problems) {
  const auto baseline = calib.has("baseline_m") ? calib.numbers("baseline_m", 1) : std::nullopt;
  if (baseline && std::abs(baseline->front() - dataset.baseline_m()) > 1e-4) {
    problems.add(source + ": baseline_m " + std::to_string(baseline->front()) +
                 " contradicts T_right_left, which says " + std::to_string(dataset.baseline_m()));
  }
}

void read_extrinsics(const CalibFile& calib,
                     const std::string& source,
                     Dataset& dataset,
                     Problems& problems) {
  if (dataset.has_right) {
    const auto right_from_left = calib.transform("T_right_left");
    if (right_from_left) {
      dataset.right_from_left = *right_from_left;
      check_baseline(dataset, source, problems);
      check_stated_baseline(calib, source, dataset, problems);
    }
  }
  if (dataset.has_scans) {
    dataset.left_from_velo = calib.transform("T_left_velo").value_or(dataset.left_from_velo);
  }
}

}  // namespace

Dataset read_plain_layout(const std::string& folder, Problems& problems) {
  Dataset dataset;
  dataset.is_z_up = true;
  const std::vector<Eigen::Isometry3d> poses = read_poses(folder + "/poses.txt", problems);
  const std::vector<double> times = read_times(folder + "/times.txt", problems);
  dataset.frames.resize(poses.size());
  const FrameFolders folders = folders_in(folder);
  find_files(
      folders, frame_names(folders.left, poses.size(), "poses.txt", problems), dataset, problems);
  const std::string calib_path = folder + "/calib.txt";
  const CalibFile calib(calib_path, problems);
  read_extrinsics(calib, calib_path, dataset, problems);
  const auto intrinsics = calib.matrix3("K");
  if (intrinsics) {
    set_camera(*intrinsics, calib_path, dataset, problems);
  }
  set_poses(poses, dataset);
  set_stamps(times, folder + "/times.txt", dataset, problems);
  return dataset;
}

}  // namespace facet_mapping
