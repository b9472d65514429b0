// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The best plane of each pixel, over all directions.
#pragma once

#include <vector>

#include "sweep_planes.h"
#include <opencv2/core.hpp>

namespace facet_mapping::detail {

class SweepWinners {
 public:
  /// Inverse depths farther apart than `tolerance` (1/m) are different depths.
  SweepWinners(const cv::Size& size, const PinholeCamera& camera, double tolerance);

  /// Takes the smoothed costs of one direction's planes (smooth_costs()) into account.
  void add(const cv::Mat& sums, const SweepPlanes& planes);

  /// CV_32F, 1/m: the parabola's lowest point about the best plane.
  cv::Mat inverse_depths() const;
  /// CV_8UC1, 255 where another depth's cost is not larger by the share `min_uniqueness`.
  cv::Mat unsure(double min_uniqueness) const;

 private:
  struct Winner {
    float inverse_depth = 0.0F;
    float cost = 1e9F;
    float other_cost = 1e9F;  // the least at another depth
  };

  Winner best_plane(const std::int16_t* sums, const SweepPlanes& planes, double slope) const;
  void merge(const Winner& challenger, Winner* winner) const;

  cv::Size size_;
  PinholeCamera camera_;
  float tolerance_;
  std::vector<Winner> winners_;
};

}  // namespace facet_mapping::detail
