// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the partners of one view, per pixel of that view.
#pragma once

#include <cstddef>

#include <opencv2/core.hpp>

namespace facet_mapping {

struct PixelForces {
  double energy = 0.0;
  std::size_t pixels = 0;
  cv::Mat force;      ///< CV_32FC1: d energy per metre along the normal; empty until added to
  cv::Mat curvature;  ///< CV_32FC1: its second-order bound

  void add(const cv::Mat& more_force, const cv::Mat& more_curvature) {
    if (force.empty()) {
      force = more_force.clone();
      curvature = more_curvature.clone();
    } else {
      force += more_force;
      curvature += more_curvature;
    }
  }
};

}  // namespace facet_mapping
