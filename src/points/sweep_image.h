// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the sweeper knows of a used image.
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping::detail {

struct SweepImage {
  View view;
  cv::Mat gray;    // CV_8UC1
  cv::Mat labels;  // CV_16UC1 or empty
  double stamp = 0.0;
  View small_view;
  cv::Mat small_gray;     // CV_8UC1, as swept
  cv::Mat fine_gray;      // CV_8UC1, twice as large: its nearest pixel is near enough
  cv::Mat inverse_depth;  // CV_32F, as swept, 1/m, NaN where unknown; empty until swept
};

/// The images that a reference is compared with, on either side of it in time: what is hidden from
/// one side is mostly seen from the other.
struct SweepNeighbours {
  std::vector<const SweepImage*> before;
  std::vector<const SweepImage*> after;

  bool empty() const { return before.empty() && after.empty(); }
  std::vector<const SweepImage*> all() const {
    std::vector<const SweepImage*> both = before;
    both.insert(both.end(), after.begin(), after.end());
    return both;
  }
};

}  // namespace facet_mapping::detail
