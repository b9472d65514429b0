// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_smoothing.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <tbb/parallel_for.h>

namespace facet_mapping::detail {
namespace {

using Cost = std::int16_t;

constexpr Cost kSmallChange = 10;  // penalty of a step to the next plane
constexpr Cost kJump = 80;         // penalty of a larger step on even grey
constexpr Cost kLeastJump = 24;    // ... on a strong edge
constexpr int kEdge = 12;          // grey difference that halves the penalty
constexpr Cost kNever = 8000;
constexpr int kBlock = 16;  // columns that one thread follows downwards together

/// Costs along a path at one pixel; a plane more on each side, which is never chosen.
class PathCosts {
 public:
  explicit PathCosts(int planes) : costs_(static_cast<std::size_t>(planes) + 2, kNever) {}

  void start(const std::uint8_t* costs, int planes, Cost* sums) {
    least_ = kNever;
    for (int k = 0; k < planes; ++k) {
      costs_[k + 1] = costs[k];
      sums[k] = static_cast<Cost>(sums[k] + costs[k]);
      least_ = std::min(least_, costs_[k + 1]);
    }
  }

  void go_on(
      const PathCosts& before, const std::uint8_t* costs, int planes, Cost jump, Cost* sums) {
    const Cost* last = before.costs_.data() + 1;
    Cost* now = costs_.data() + 1;
    const Cost offset = before.least_;
    const auto cap = static_cast<Cost>(offset + jump);
    Cost least = kNever;
    for (int k = 0; k < planes; ++k) {
      const auto below = static_cast<Cost>(last[k - 1] + kSmallChange);
      const auto above = static_cast<Cost>(last[k + 1] + kSmallChange);
      const Cost cheapest = std::min(std::min(last[k], cap), std::min(below, above));
      const auto cost = static_cast<Cost>(costs[k] + cheapest - offset);
      now[k] = cost;
      sums[k] = static_cast<Cost>(sums[k] + cost);
      least = std::min(least, cost);
    }
    least_ = least;
  }

 private:
  std::vector<Cost> costs_;
  Cost least_ = 0;
};

Cost jump_penalty(int a, int b) {
  return std::max(kLeastJump, static_cast<Cost>(kJump * kEdge / (kEdge + std::abs(a - b))));
}

class Smoothing {
 public:
  Smoothing(const cv::Mat& costs, const cv::Mat& gray)
      : costs_(costs), gray_(gray), planes_(costs.cols), sums_(costs.size(), CV_16SC1) {}

  cv::Mat run() {
    tbb::parallel_for(0, gray_.rows, [&](int y) { follow_row(y); });
    const int blocks = (gray_.cols + kBlock - 1) / kBlock;
    tbb::parallel_for(0, blocks, [&](int b) {
      const int end = std::min((b + 1) * kBlock, gray_.cols);
      follow_columns(b * kBlock, end, 0, 1);
      follow_columns(b * kBlock, end, gray_.rows - 1, -1);
    });
    return sums_;
  }

 private:
  void follow_row(int y) {
    std::fill_n(sums_.ptr<Cost>(y * gray_.cols),
                static_cast<std::size_t>(gray_.cols) * static_cast<std::size_t>(planes_),
                Cost{0});
    PathCosts last(planes_);
    PathCosts now(planes_);
    for (const int step : {1, -1}) {
      const int first = step > 0 ? 0 : gray_.cols - 1;
      now.start(costs(first, y), planes_, sums(first, y));
      for (int x = first + step; x >= 0 && x < gray_.cols; x += step) {
        std::swap(last, now);
        now.go_on(last, costs(x, y), planes_, penalty(x, y, x - step, y), sums(x, y));
      }
    }
  }

  void follow_columns(int begin, int end, int first, int step) {
    std::vector<PathCosts> last(static_cast<std::size_t>(end - begin), PathCosts(planes_));
    std::vector<PathCosts> now = last;
    for (int x = begin; x < end; ++x) {
      now[x - begin].start(costs(x, first), planes_, sums(x, first));
    }
    for (int y = first + step; y >= 0 && y < gray_.rows; y += step) {
      std::swap(last, now);
      for (int x = begin; x < end; ++x) {
        now[x - begin].go_on(
            last[x - begin], costs(x, y), planes_, penalty(x, y, x, y - step), sums(x, y));
      }
    }
  }

  const std::uint8_t* costs(int x, int y) const { return costs_.ptr(y * gray_.cols + x); }
  Cost* sums(int x, int y) { return sums_.ptr<Cost>(y * gray_.cols + x); }
  Cost penalty(int x, int y, int from_x, int from_y) const {
    return jump_penalty(gray_.at<std::uint8_t>(y, x), gray_.at<std::uint8_t>(from_y, from_x));
  }

  const cv::Mat& costs_;
  const cv::Mat& gray_;
  int planes_;
  cv::Mat sums_;
};

}  // namespace

cv::Mat smooth_costs(const cv::Mat& costs, const cv::Mat& gray) {
  return Smoothing(costs, gray).run();
}

}  // namespace facet_mapping::detail
