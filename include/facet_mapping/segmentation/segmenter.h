// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Classes of an image's pixels, for people without a segmentation topic.
#pragma once

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

/// A camera above a ground plane: what its pose says about an image.
struct GroundView {
  View view;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector, frame of the pose
  double ground_m = 0.0;  ///< the plane is up . x = ground_m, frame of the pose
};

/// Not thread-safe: one image at a time.
class Segmenter {
 public:
  /// Pixels less sure than `min_confidence` become kUnlabelled.
  explicit Segmenter(double min_confidence) : min_confidence_(min_confidence) {}
  Segmenter(const Segmenter&) = delete;
  Segmenter& operator=(const Segmenter&) = delete;
  virtual ~Segmenter() = default;

  /// Class ids (CV_16UC1, kUnlabelled where unsure) of a CV_8UC3 (BGR) image, of its size;
  /// `confidence` becomes CV_32FC1, the probability of the most likely class. Throws
  /// std::invalid_argument on another image, std::runtime_error if the model cannot cope.
  cv::Mat segment(const cv::Mat& bgr, cv::Mat* confidence = nullptr);

  /// The same where the camera's pose is known; models without use for it ignore it.
  cv::Mat segment(const cv::Mat& bgr, const GroundView& ground, cv::Mat* confidence = nullptr);

 private:
  cv::Mat sure_labels(const cv::Mat& bgr, const GroundView* ground, cv::Mat* confidence);
  /// Fills `confidence`.
  virtual cv::Mat run(const cv::Mat& bgr, const GroundView* ground, cv::Mat* confidence) = 0;

  double min_confidence_;
};

/// Throws std::invalid_argument unless the image is CV_8UC3 with pixels.
void check_color_image(const cv::Mat& bgr);

}  // namespace facet_mapping
