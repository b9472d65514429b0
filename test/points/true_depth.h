// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points against the depth images of real data.
#pragma once

#include <cmath>
#include <cstddef>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping::test {

struct Shares {
  std::size_t points = 0;
  double within_1 = 0.0;
  double within_3 = 0.0;
  double within_5 = 0.0;

  void add(double depth, double truth) {
    const double error = std::abs(depth - truth) / truth;
    ++points;
    within_1 += error <= 0.01 ? 1.0 : 0.0;
    within_3 += error <= 0.03 ? 1.0 : 0.0;
    within_5 += error <= 0.05 ? 1.0 : 0.0;
  }

  void divide() {
    for (double* share : {&within_1, &within_3, &within_5}) {
      *share /= static_cast<double>(points);
    }
  }
};

/// Compares the points of a frame in a camera of the size of `true_depth` (CV_32FC1, metres).
inline void compare(const PointFrame& frame,
                    const PinholeCamera& camera,
                    const cv::Mat& true_depth,
                    Shares* shares) {
  for (const LabeledPoint& point : frame.points) {
    const Eigen::Vector2d pixel = camera.project(point.position.cast<double>());
    const cv::Point nearest(static_cast<int>(std::lround(pixel.x())),
                            static_cast<int>(std::lround(pixel.y())));
    if (cv::Rect(0, 0, true_depth.cols, true_depth.rows).contains(nearest) &&
        true_depth.at<float>(nearest) > 0.0F) {
      shares->add(point.position.z(), true_depth.at<float>(nearest));
    }
  }
}

}  // namespace facet_mapping::test
