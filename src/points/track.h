// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the tracker knows of an image and of a feature followed through images.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/label.h"

namespace facet_mapping::detail {

/// The newest used image.
struct TrackImage {
  View view;
  cv::Mat gray;    // CV_8UC1
  cv::Mat even;    // CV_8UC1, brightness and contrast evened out
  cv::Mat labels;  // CV_16UC1 or empty
};

struct UsedView {
  View view;
  double stamp = 0.0;      // seconds
  std::size_t number = 0;  // used images are counted without gaps
};

struct Observation {
  std::shared_ptr<const UsedView> from;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  /// Unit normal of the edge; zero at a corner. Along an edge the pixel is not known well.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  Label label = kUnlabelled;

  bool is_corner() const { return normal.isZero(); }
};

/// A position with its uncertainty.
struct Triangulated {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();        // world
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // square metres
  double rms_px = 0.0;
  double parallax_rad = 0.0;  // largest angle between the first ray and another

  /// Standard deviation along the ray from `eye`.
  double sigma_from(const Eigen::Vector3d& eye) const;
};

struct Track {
  std::vector<Observation> observations;  // from used images without gaps
  std::optional<Triangulated> point;
  bool is_alive = true;

  const Observation& last() const { return observations.back(); }
};

}  // namespace facet_mapping::detail
