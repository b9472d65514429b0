// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The inner loop of the software renderer: one triangle into one band of rows, nearest wins.
#pragma once

#include <array>
#include <cstdint>

#include "render/screen.h"
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
  TriangleFiller(const Screen& screen, Band band);

  /// `plane` is asked for the depth only if the box of the corners holds a pixel centre.
  template <typename Plane>
  void fill(const ScreenVertex& a,
            const ScreenVertex& b,
            const ScreenVertex& c,
            const Plane& plane,
            std::int32_t facet) {
    const Box bounds = box(a, b, c);
    if (!bounds.empty()) {
      fill_box(bounds, a, b, c, plane(), facet);
    }
  }

 private:
  struct Box {
    int x_begin, x_last, y_begin, y_last;
    bool empty() const { return x_begin > x_last || y_begin > y_last; }
  };

  /// step * x + row * y + constant >= 0 for pixels (x, y) on the inner side.
  struct Edge {
    std::int64_t step, row, constant;
    double inverse_step;
    void narrow(int y, int* begin, int* last) const;
  };

  Box box(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) const;
  Edge edge(const ScreenVertex& from, const ScreenVertex& to) const;
  void fill_box(const Box& bounds,
                const ScreenVertex& a,
                const ScreenVertex& b,
                const ScreenVertex& c,
                const InverseDepth& depth,
                std::int32_t facet);
  void fill_small(const Box& bounds,
                  const std::array<Edge, 3>& edges,
                  const InverseDepth& depth,
                  std::int32_t facet);
  void fill_spans(const Box& bounds,
                  const std::array<Edge, 3>& edges,
                  const InverseDepth& depth,
                  std::int32_t facet);

  int bits_;
  Band band_;
};

/// The depth of the facet with corners a, b, c over the image.
InverseDepth inverse_depth(const PinholeCamera& camera,
                           const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c);

}  // namespace facet_mapping
