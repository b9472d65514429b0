// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_winners.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <tbb/parallel_for.h>

namespace facet_mapping::detail {
namespace {

/// Place of the lowest point of the parabola through three neighbours, relative to the middle.
float parabola_offset(float before, float middle, float after) {
  const float bend = before - 2.0F * middle + after;
  return bend > 0.0F ? std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F) : 0.0F;
}

}  // namespace

SweepWinners::SweepWinners(const cv::Size& size, const PinholeCamera& camera, double tolerance)
    : size_(size),
      camera_(camera),
      tolerance_(static_cast<float>(tolerance)),
      winners_(static_cast<std::size_t>(size.area())) {}

void SweepWinners::add(const cv::Mat& sums, const SweepPlanes& planes) {
  tbb::parallel_for(0, size_.height, [&](int y) {
    for (int x = 0; x < size_.width; ++x) {
      const double slope = planes.normal.dot(camera_.ray({x, y}));
      if (slope > 0.0) {
        const int pixel = y * size_.width + x;
        merge(best_plane(sums.ptr<std::int16_t>(pixel), planes, slope), &winners_[pixel]);
      }
    }
  });
}

SweepWinners::Winner SweepWinners::best_plane(const std::int16_t* sums,
                                              const SweepPlanes& planes,
                                              double slope) const {
  const int count = static_cast<int>(planes.inverse_distances.size());
  const int best = static_cast<int>(std::min_element(sums, sums + count) - sums);
  const double step = planes.inverse_distances[1] - planes.inverse_distances[0];
  Winner winner;
  winner.cost = sums[best];
  double place = planes.inverse_distances[best];
  if (best > 0 && best + 1 < count) {
    place += step * parabola_offset(sums[best - 1], sums[best], sums[best + 1]);
  }
  winner.inverse_depth = static_cast<float>(slope * place);
  const int apart = std::max(2, static_cast<int>(std::ceil(tolerance_ / (slope * step))));
  for (int k = 0; k < count; ++k) {
    if (std::abs(k - best) >= apart) {
      winner.other_cost = std::min(winner.other_cost, static_cast<float>(sums[k]));
    }
  }
  return winner;
}

void SweepWinners::merge(const Winner& challenger, Winner* winner) const {
  Winner best = challenger.cost < winner->cost ? challenger : *winner;
  const Winner& beaten = challenger.cost < winner->cost ? *winner : challenger;
  best.other_cost = std::min(best.other_cost, beaten.other_cost);
  if (std::abs(best.inverse_depth - beaten.inverse_depth) > tolerance_) {
    best.other_cost = std::min(best.other_cost, beaten.cost);
  }
  *winner = best;
}

cv::Mat SweepWinners::inverse_depths() const {
  cv::Mat result(size_, CV_32FC1);
  std::transform(winners_.begin(), winners_.end(), result.begin<float>(), [](const Winner& w) {
    return w.inverse_depth;
  });
  return result;
}

cv::Mat SweepWinners::unsure(double min_uniqueness) const {
  cv::Mat result(size_, CV_8UC1);
  const auto factor = static_cast<float>(1.0 + min_uniqueness);
  std::transform(winners_.begin(),
                 winners_.end(),
                 result.begin<std::uint8_t>(),
                 [&](const Winner& w) -> std::uint8_t {
                   return w.other_cost >= factor * w.cost && w.inverse_depth > 0.0F ? 0 : 255;
                 });
  return result;
}

}  // namespace facet_mapping::detail
