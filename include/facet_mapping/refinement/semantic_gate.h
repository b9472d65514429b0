// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where the semantic energy looks: near the borders between rendered classes (chi of Romanoni et
// al. 2017, Eq. 9).
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping {

/// C_l(w) = number of pixels u with chi_l(u) = 1 whose window contains w, over the window's area;
/// chi_l(u) = 1 if the window around u on the rendered mask of class l has pixels in and out of the
/// class. Only pixels with some C_l above zero are stored.
///
/// With it sum_u chi_l(u) sum_{w in W(u)} (M2 - M3)^2 / |W| = sum_w C_l(w) (M2 - M3)^2.
class SemanticGate {
 public:
  SemanticGate() = default;

  /// `rendered`: CV_16UC1 classes of the rendered mesh, kUnlabelled being no class at all.
  SemanticGate(const cv::Mat& rendered, int window_px);

  /// C_l(w); `pixel` = row * width + column.
  double weight(std::uint32_t pixel, Label label) const;

  /// Energy of pixel w if the mesh showed class `shown` there and the segmentation says `seen`
  /// (e_q(w) of the derivation): 0 if they agree or the segmentation says nothing, else
  /// C_shown + C_seen.
  double cost(std::uint32_t pixel, Label shown, Label seen) const;

  /// Sum of cost() over all gated pixels of a rendering (which may be newer than the gate).
  double energy(const cv::Mat& rendered, const cv::Mat& segmentation) const;

  /// Number of (u, l) with chi_l(u) = 1.
  std::size_t size() const { return size_; }

 private:
  struct Entry {
    Label label;
    float weight;
  };

  std::vector<std::uint32_t> pixels_;  // ascending
  std::vector<std::uint32_t> offsets_;
  std::vector<Entry> entries_;
  std::size_t size_ = 0;

  double row_weight(std::size_t row, Label label) const;
  double row_cost(std::size_t row, Label shown, Label seen) const;
};

}  // namespace facet_mapping
