// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two images can be a rectified stereo pair at all, from a few corners found in both.
#pragma once

#include <cstddef>
#include <string>

#include <opencv2/core.hpp>

namespace facet_mapping {

enum class StereoPairProblem {
  kNone,
  kBlank,       ///< one image has hardly any contrast
  kSwapped,     ///< corners lie farther to the right in the right image
  kRowsDiffer,  ///< corners lie higher or lower: not rectified, or not of one moment
  kNoMatch,     ///< hardly a corner of the left image is in the right one
  kExposure     ///< one image is much brighter
};

struct StereoPairCheckConfig {
  int search_px = 128;                ///< corners are looked for so far to the left and right
  int search_rows_px = 16;            ///< and so far up and down
  double least_contrast = 3.0;        ///< standard deviation of an image's grey values
  double least_matched_share = 0.15;  ///< of the corners
  double largest_row_error_px = 1.0;  ///< median distance of the rows
  double largest_brightness_ratio = 1.6;
};

struct StereoPairReport {
  StereoPairProblem problem = StereoPairProblem::kNone;
  std::string sentence;           ///< what is wrong and what to do; empty without problem
  std::size_t corners = 0;        ///< looked for
  std::size_t matched = 0;        ///< found beyond doubt
  double swapped_share = 0.0;     ///< of the matched: farther to the right in the right image
  double row_error_px = 0.0;      ///< median |difference of the rows| of the matched
  double brightness_ratio = 1.0;  ///< right to left, median over the matched
};

/// Looks for strong corners of the left image in both directions in the right one, by normalised
/// correlation (a difference of exposure does not matter for it); wide images at half size. Takes
/// some 20 ms, so call it now and then. A pair with few corners (fog, a bare wall) has no problem
/// unless an image is blank: nothing can be said. CV_8UC1 of equal size, else
/// std::invalid_argument; an empty pair is blank.
StereoPairReport check_stereo_pair(const cv::Mat& left,
                                   const cv::Mat& right,
                                   const StereoPairCheckConfig& config = {});

}  // namespace facet_mapping
