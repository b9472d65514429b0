// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_filler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

InverseDepth inverse_depth(const PinholeCamera& camera,
                           const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double inverse_offset = 1.0 / normal.dot(a);
  InverseDepth depth;
  depth.du = normal.x() * inverse_offset / camera.fx;
  depth.dv = normal.y() * inverse_offset / camera.fy;
  depth.constant = normal.z() * inverse_offset - depth.du * camera.cx - depth.dv * camera.cy;
  if (!std::isfinite(depth.du) || !std::isfinite(depth.dv) || !std::isfinite(depth.constant)) {
    // Seen exactly edge-on: no plane, so take the nearest corner (the limits do it).
    depth.du = 0.0;
    depth.dv = 0.0;
    depth.constant = 1.0 / kNearDepth;
  }
  return depth;
}

TriangleFiller::Box TriangleFiller::box(const ScreenVertex& a,
                                        const ScreenVertex& b,
                                        const ScreenVertex& c) const {
  const int bits = screen_.bits();
  const int round_up = (1 << bits) - 1;
  return {std::max((std::min({a.x, b.x, c.x}) + round_up) >> bits, 0),
          std::min(std::max({a.x, b.x, c.x}) >> bits, band_.facets.cols - 1),
          std::max((std::min({a.y, b.y, c.y}) + round_up) >> bits, band_.begin),
          std::min(std::max({a.y, b.y, c.y}) >> bits, band_.end - 1)};
}

bool TriangleFiller::misses(const ScreenVertex& a,
                            const ScreenVertex& b,
                            const ScreenVertex& c) const {
  return box(a, b, c).empty();
}

TriangleFiller::Edge TriangleFiller::edge(const ScreenVertex& from, const ScreenVertex& to) const {
  const double dx = static_cast<double>(to.x) - from.x;
  const double dy = static_cast<double>(to.y) - from.y;
  // Left and top edges own the pixel centres that lie on them, the others do not.
  const bool owns = dy < 0.0 || (dy == 0.0 && dx > 0.0);
  const double scale = std::ldexp(1.0, screen_.bits());
  Edge edge{};
  edge.step = -dy * scale;
  edge.row = dx * scale;
  edge.constant = dy * from.x - dx * from.y - (owns ? 0.0 : 1.0);
  edge.inverse_step = dy == 0.0 ? 0.0 : 1.0 / edge.step;
  return edge;
}

// The division only guesses the end of the span; the exact edge function decides.
void TriangleFiller::Edge::narrow(int y, int* begin, int* last) const {
  const double value = row * y + constant;
  if (step == 0.0) {
    *last = value >= 0.0 ? *last : *begin - 1;
    return;
  }
  const double guess = std::clamp(-value * inverse_step, *begin - 1.0, *last + 1.0);
  int x = static_cast<int>(guess);
  if (step > 0.0) {
    while (x > *begin && step * (x - 1) + value >= 0.0) {
      --x;
    }
    while (x <= *last && step * x + value < 0.0) {
      ++x;
    }
    *begin = std::max(*begin, x);
  } else {
    while (x < *last && step * (x + 1) + value >= 0.0) {
      ++x;
    }
    while (x >= *begin && step * x + value < 0.0) {
      --x;
    }
    *last = std::min(*last, x);
  }
}

void TriangleFiller::fill_row(
    int y, int begin, int last, const InverseDepth& depth, std::int32_t facet) {
  float* const nearest = band_.inverse_z.ptr<float>(y);
  auto* const ids = band_.facets.ptr<std::int32_t>(y);
  const double row = depth.dv * y + depth.constant;
  for (int x = begin; x <= last; ++x) {
    const float value =
        std::min(std::max(static_cast<float>(depth.du * x + row), depth.low), depth.high);
    if (value > nearest[x]) {
      nearest[x] = value;
      ids[x] = facet;
    }
  }
}

void TriangleFiller::fill(const ScreenVertex& a,
                          const ScreenVertex& b,
                          const ScreenVertex& c,
                          const InverseDepth& depth,
                          std::int32_t facet) {
  const Box bounds = box(a, b, c);
  if (bounds.empty()) {
    return;
  }
  const double area = (static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y) -
                      (static_cast<double>(b.y) - a.y) * (static_cast<double>(c.x) - a.x);
  if (area == 0.0) {
    return;
  }
  const ScreenVertex& second = area > 0.0 ? b : c;
  const ScreenVertex& third = area > 0.0 ? c : b;
  const std::array<Edge, 3> edges{edge(a, second), edge(second, third), edge(third, a)};
  for (int y = bounds.y_begin; y <= bounds.y_last; ++y) {
    int begin = bounds.x_begin;
    int last = bounds.x_last;
    for (const Edge& side : edges) {
      side.narrow(y, &begin, &last);
    }
    fill_row(y, begin, last, depth, facet);
  }
}

}  // namespace facet_mapping
