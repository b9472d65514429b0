// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The inner loop of the software renderer: one triangle into one band of rows, nearest wins.
#pragma once

#include <array>
#include <cstdint>

#include "screen.h"
#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace facet_mapping {

/// 1/z over the image: value(u, v) = du * u + dv * v + constant, kept within [low, high].
struct InverseDepth {
  double du = 0.0;
  double dv = 0.0;
  double constant = 0.0;
  float low = 0.0F;
  float high = 0.0F;
};

/// Rows [begin, end) of an image under construction; `inverse_z` is 0 where nothing is drawn yet.
struct Band {
  int begin = 0;
  int end = 0;
  cv::Mat facets;     ///< CV_32SC1
  cv::Mat inverse_z;  ///< CV_32FC1, 1/metres
};

class TriangleFiller {
 public:
  TriangleFiller(const Screen& screen, const Band& band) : screen_(screen), band_(band) {}

  /// True if the box of the three positions holds no pixel centre of the band.
  bool misses(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) const;

  void fill(const ScreenVertex& a,
            const ScreenVertex& b,
            const ScreenVertex& c,
            const InverseDepth& depth,
            std::int32_t facet);

 private:
  struct Box {
    int x_begin, x_last, y_begin, y_last;
    bool empty() const { return x_begin > x_last || y_begin > y_last; }
  };

  /// step * x + row * y + constant >= 0 for pixels (x, y) on the inner side; exact integers.
  struct Edge {
    double step, row, constant, inverse_step;
    void narrow(int y, int* begin, int* last) const;
  };

  Box box(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) const;
  Edge edge(const ScreenVertex& from, const ScreenVertex& to) const;
  void fill_row(int y, int begin, int last, const InverseDepth& depth, std::int32_t facet);

  const Screen& screen_;
  Band band_;
};

/// The depth of the facet with corners a, b, c over the image.
InverseDepth inverse_depth(const PinholeCamera& camera,
                           const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c);

}  // namespace facet_mapping
