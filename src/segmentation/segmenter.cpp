// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/segmentation/segmenter.h"

#include <stdexcept>
#include <string>

#include "facet_mapping/geometry/label.h"
#include "facet_mapping/geometry/size_text.h"

namespace facet_mapping {
void check_color_image(const cv::Mat& bgr) {
  if (bgr.empty()) {
    throw std::invalid_argument("The image to segment is empty; check its source");
  }
  if (bgr.type() != CV_8UC3) {
    throw std::invalid_argument(
        "The image to segment has " + std::to_string(bgr.channels()) +
        " channels of another kind than 8-bit blue, green, red; convert it first");
  }
}

cv::Mat Segmenter::sure_labels(const cv::Mat& bgr, const GroundView* ground, cv::Mat* confidence) {
  cv::Mat probability;
  cv::Mat labels = run(bgr, ground, &probability);
  if (min_confidence_ > 0.0) {
    labels.setTo(kUnlabelled, probability < min_confidence_);
  }
  if (confidence != nullptr) {
    *confidence = probability;
  }
  return labels;
}

cv::Mat Segmenter::segment(const cv::Mat& bgr, cv::Mat* confidence) {
  check_color_image(bgr);
  return sure_labels(bgr, nullptr, confidence);
}

cv::Mat Segmenter::segment(const cv::Mat& bgr, const GroundView& ground, cv::Mat* confidence) {
  check_color_image(bgr);
  const PinholeCamera& camera = ground.view.camera;
  if (!camera.is_valid() || camera.width != bgr.cols || camera.height != bgr.rows) {
    throw std::invalid_argument("The image to segment has " + size_text(bgr.cols, bgr.rows) +
                                " pixels, but its camera is for " +
                                size_text(camera.width, camera.height) + "; give the image's own");
  }
  return sure_labels(bgr, &ground, confidence);
}

}  // namespace facet_mapping
