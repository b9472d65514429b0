// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a dataset folder.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "facet_mapping/synthetic/street.h"
#include "facet_mapping/synthetic/street_rig.h"

namespace facet_mapping {

class DatasetFiles {
 public:
  /// Makes the sub-folders and removes poses.txt. Throws std::runtime_error if that fails or frames
  /// beyond `frames` are there.
  DatasetFiles(const std::string& folder, std::size_t frames);

  // Each throws std::runtime_error with path and reason. Images are written as PNG.
  void write_image(const char* kind, std::size_t frame, const cv::Mat& image) const;
  void write_scan(std::size_t frame, const std::vector<Eigen::Vector4f>& scan) const;
  void write_calibration(const StreetRig& rig) const;
  void write_times(const std::vector<StreetPose>& poses) const;
  void write_poses(const std::vector<StreetPose>& poses) const;

  std::string path(const std::string& name) const { return folder_ + "/" + name; }

 private:
  std::string folder_;
};

}  // namespace facet_mapping
