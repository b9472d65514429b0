// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Zero-mean normalised cross-correlation over square windows and its derivative, by box filters
// only, so that the cost does not depend on the window (Pons et al. 2007; Vu et al. 2012).
#pragma once

#include <cstddef>
#include <cstdint>

#include <opencv2/core.hpp>

namespace facet_mapping {

/// Mean and variance of an image over the window around each pixel, both CV_32FC1.
struct WindowStats {
  cv::Mat mean;
  cv::Mat variance;
};

WindowStats window_stats(const cv::Mat& image, int window_px);

struct ZnccConfig {
  int window_px = 5;  ///< side of the window, odd
  /// Standard deviation, in grey levels, below which a window's texture is taken for noise.
  double noise_gray = 2.0;
};

constexpr double kEnergyUnits = 30000.0;  ///< energies are 0 .. 2
constexpr std::uint16_t kNotCounted = 0xFFFF;

struct ZnccResult {
  double energy = 0.0;     ///< sum of r * (1 - zncc) over the counted pixels
  std::size_t pixels = 0;  ///< pixels whose whole window is valid
  /// CV_16UC1: each pixel's energy in units of 1 / kEnergyUnits, or kNotCounted.
  cv::Mat map;
  /// CV_32FC1: d energy / d warped(w), reliability included.
  cv::Mat derivative;
  /// CV_32FC1: b(w) such that 1/2 sum b(w) dw^2 bounds the second-order change of the energy at
  /// a match (Gauss-Newton, the mean and the scale of the windows left out).
  cv::Mat curvature;
};

/// Energy E = sum r (1 - zncc) between `image` and `warped` (CV_32FC1) with Pons' reliability
/// r = sI^2 sJ^2 / (sI^2 sJ^2 + noise^4). A pixel counts if all pixels of its window are non-zero
/// in `valid` (CV_8UC1), so that holes in `valid` grow by the window. The derivative follows r
/// too: leaving it out would pull the surface to where the partner's texture is strong.
ZnccResult zncc_energy(const cv::Mat& image,
                       const WindowStats& stats,
                       const cv::Mat& warped,
                       const cv::Mat& valid,
                       const ZnccConfig& config,
                       bool with_derivative = true);

}  // namespace facet_mapping
