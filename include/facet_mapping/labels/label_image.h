// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Label images of every encoding, turned into CV_16UC1 class ids. Labels are never interpolated.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include <opencv2/core.hpp>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {

/// What was met while decoding, so that nothing wrong passes silently.
struct LabelImageReport {
  std::map<int, std::size_t> unknown_ids;  ///< id -> pixels; such pixels become kUnlabelled
  std::size_t unknown_color_pixels = 0;    ///< colour-coded pixels that match no class
  std::size_t pixels = 0;
  bool looks_swapped = false;  ///< exchanging red and blue would explain the colours
  bool looks_lossy = false;    ///< hundreds of unknown colours: JPEG, smooth resizing, no labels

  bool clean() const { return unknown_ids.empty() && unknown_color_pixels == 0; }
  /// One sentence: how many pixels are of no known class, why most likely, what to do.
  std::string to_string() const;
};

/// Decodes ids (8-bit, 16-bit or 32-bit single channel; encodings mono8, 8UC1, mono16, 16UC1,
/// 32SC1) or colour codes (rgb8, bgr8) into CV_16UC1. Ignored classes, id 65535 and whatever the
/// label set does not know become kUnlabelled. Throws std::invalid_argument on any other encoding,
/// on pixels that do not fit it, an empty image or an empty label set; the sentence says what to
/// send.
cv::Mat decode_label_image(const cv::Mat& image,
                           const std::string& encoding,
                           const LabelSet& labels,
                           LabelImageReport* report = nullptr);

/// Nearest-neighbour resampling of CV_16UC1 ids to the size of the paired image; pixel areas are
/// kept, as in PinholeCamera::resized. Throws std::invalid_argument on another type or size <= 0.
cv::Mat resize_label_image(const cv::Mat& labels, const cv::Size& size);

/// CV_8UC3 (BGR) picture of a class image for people. Throws std::invalid_argument unless CV_16UC1.
cv::Mat color_label_image(const cv::Mat& labels, const LabelSet& label_set);

}  // namespace facet_mapping
