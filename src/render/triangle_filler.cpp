// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/triangle_filler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

// Narrower boxes are tested pixel by pixel, wider ones are cut to spans.
constexpr int kSmallWidth = 12;

/// The part of a row that is being drawn; values instead of references keep the loops in registers.
struct Row {
  Row(Band* band, const InverseDepth& depth, int y)
      : nearest(band->inverse_z.ptr<float>(y)),
        ids(band->facets.ptr<std::int32_t>(y)),
        step(depth.du),
        start(depth.dv * y + depth.constant),
        low(depth.low),
        high(depth.high) {}

  void draw(int x, std::int32_t facet) const {
    const float value = std::min(std::max(static_cast<float>(step * x + start), low), high);
    if (value > nearest[x]) {
      ids[x] = facet;
      nearest[x] = value;
    }
  }

  float* nearest;
  std::int32_t* ids;
  double step;
  double start;
  float low;
  float high;
};

}  // namespace

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

TriangleFiller::TriangleFiller(const Screen& screen, Band band)
    : bits_(screen.bits()), band_(std::move(band)) {}

TriangleFiller::Box TriangleFiller::box(const ScreenVertex& a,
                                        const ScreenVertex& b,
                                        const ScreenVertex& c) const {
  const int round_up = (1 << bits_) - 1;
  return {std::max((std::min({a.x, b.x, c.x}) + round_up) >> bits_, 0),
          std::min(std::max({a.x, b.x, c.x}) >> bits_, band_.facets.cols - 1),
          std::max((std::min({a.y, b.y, c.y}) + round_up) >> bits_, band_.begin),
          std::min(std::max({a.y, b.y, c.y}) >> bits_, band_.end - 1)};
}

TriangleFiller::Edge TriangleFiller::edge(const ScreenVertex& from, const ScreenVertex& to) const {
  const std::int64_t dx = static_cast<std::int64_t>(to.x) - from.x;
  const std::int64_t dy = static_cast<std::int64_t>(to.y) - from.y;
  // Left and top edges own the pixel centres that lie on them, the others do not.
  const bool owns = dy < 0 || (dy == 0 && dx > 0);
  const std::int64_t scale = std::int64_t{1} << bits_;
  return {-dy * scale, dx * scale, dy * from.x - dx * from.y - (owns ? 0 : 1), 0.0};
}

// The division only guesses the end of the span; the exact edge function decides.
void TriangleFiller::Edge::narrow(int y, int* begin, int* last) const {
  const std::int64_t value = row * y + constant;
  if (step == 0) {
    *last = value >= 0 ? *last : *begin - 1;
    return;
  }
  const double crossing = -static_cast<double>(value) * inverse_step;
  int x = static_cast<int>(std::clamp(crossing, *begin - 1.0, *last + 1.0));
  const int inward = step > 0 ? 1 : -1;
  while (x >= *begin - 1 && x <= *last + 1 && step * x + value < 0) {
    x += inward;
  }
  while (step * (x - inward) + value >= 0 && x - inward >= *begin && x - inward <= *last) {
    x -= inward;
  }
  (step > 0 ? *begin : *last) = step > 0 ? std::max(*begin, x) : std::min(*last, x);
}

void TriangleFiller::fill_spans(const Box& bounds,
                                const std::array<Edge, 3>& edges,
                                const InverseDepth& depth,
                                std::int32_t facet) {
  for (int y = bounds.y_begin; y <= bounds.y_last; ++y) {
    int begin = bounds.x_begin;
    int last = bounds.x_last;
    for (const Edge& side : edges) {
      side.narrow(y, &begin, &last);
    }
    const Row row(&band_, depth, y);
    for (int x = begin; x <= last; ++x) {
      row.draw(x, facet);
    }
  }
}

void TriangleFiller::fill_small(const Box& bounds,
                                const std::array<Edge, 3>& edges,
                                const InverseDepth& depth,
                                std::int32_t facet) {
  std::array<std::int64_t, 3> start{};
  for (std::size_t k = 0; k < start.size(); ++k) {
    start[k] = edges[k].step * bounds.x_begin + edges[k].row * bounds.y_begin + edges[k].constant;
  }
  for (int y = bounds.y_begin; y <= bounds.y_last; ++y) {
    std::array<std::int64_t, 3> value = start;
    const Row row(&band_, depth, y);
    for (int x = bounds.x_begin; x <= bounds.x_last; ++x) {
      if ((value[0] | value[1] | value[2]) >= 0) {
        row.draw(x, facet);
      }
      for (std::size_t k = 0; k < value.size(); ++k) {
        value[k] += edges[k].step;
      }
    }
    for (std::size_t k = 0; k < start.size(); ++k) {
      start[k] += edges[k].row;
    }
  }
}

void TriangleFiller::fill_box(const Box& bounds,
                              const ScreenVertex& a,
                              const ScreenVertex& b,
                              const ScreenVertex& c,
                              const InverseDepth& depth,
                              std::int32_t facet) {
  const std::int64_t area = (static_cast<std::int64_t>(b.x) - a.x) * (c.y - a.y) -
                            (static_cast<std::int64_t>(b.y) - a.y) * (c.x - a.x);
  if (area == 0) {
    return;
  }
  const ScreenVertex& second = area > 0 ? b : c;
  const ScreenVertex& third = area > 0 ? c : b;
  std::array<Edge, 3> edges{edge(a, second), edge(second, third), edge(third, a)};
  if (bounds.x_last - bounds.x_begin < kSmallWidth) {
    fill_small(bounds, edges, depth, facet);
    return;
  }
  for (Edge& side : edges) {
    side.inverse_step = side.step == 0 ? 0.0 : 1.0 / static_cast<double>(side.step);
  }
  fill_spans(bounds, edges, depth, facet);
}

}  // namespace facet_mapping
