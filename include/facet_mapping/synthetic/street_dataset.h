// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a drive along the synthetic street as a dataset folder that read_dataset understands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/synthetic/street.h"
#include "facet_mapping/synthetic/street_lidar.h"
#include "facet_mapping/synthetic/street_view.h"

namespace facet_mapping {

struct StreetDatasetConfig {
  bool full_size = false;    ///< 1242 x 375 pixels instead of 621 x 188
  double label_noise = 0.7;  ///< level of noisy_segmentation; 0 = labels/ equals gt_label/
  double gain_sigma = 0.02;  ///< standard deviation of each image's exposure, share
  double grey_sigma = 1.5;   ///< standard deviation of the pixel noise, grey levels
  bool scans = true;         ///< write velodyne/
  std::uint64_t seed = 1;    ///< of the noise; the street has a seed of its own
  StreetViewConfig view;     ///< how the pictures are made
  StreetLidarConfig lidar;   ///< how the scans are made
};

/// Frames done and frames in all; called from one thread at a time, not always the same.
using StreetProgress = std::function<void(std::size_t done, std::size_t total)>;

/// The street's classes with their names and Cityscapes colours.
LabelSet street_labels();

/// Writes into `folder` (made if missing):
///   left/ right/ (colour PNG), labels/ gt_label/ (8-bit class ids), gt_depth/ (16-bit, metres x
///   256, 0 = none), each 000000.png and on; velodyne/000000.bin (float32 x y z intensity);
///   calib.txt (K, T_right_left, T_left_velo, baseline_m), poses.txt (world_from_left, world =
///   first left camera, z forward, y down), times.txt (seconds);
///   ground_truth.ply: the street's mesh, map frame (REP-103), origin at the first left camera.
/// Depth beyond 255.99 m is 0. poses.txt comes last, so that a folder cut short is not taken for
/// complete. Files of the same name are replaced. Same input, same bytes, whatever the number of
/// threads.
/// Throws std::invalid_argument for a bad configuration, std::runtime_error if a file cannot be
/// written or the folder holds frames of a longer dataset.
void write_street_dataset(const Street& street,
                          const StreetDatasetConfig& config,
                          const std::string& folder,
                          const StreetProgress& progress = {});

}  // namespace facet_mapping
