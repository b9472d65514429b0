// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_depth.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "pixel_thinning.h"
#include "sweep_cost.h"
#include "sweep_smoothing.h"
#include "sweep_winners.h"
#include <opencv2/calib3d.hpp>

namespace facet_mapping::detail {
namespace {

constexpr double kOtherDepth = 3.0;  // planes; so far apart two depths are not the same
constexpr int kUnitsPerPlane = 16;   // of the whole numbers that speckles are found in
constexpr double kJump = 2.5;        // planes; neighbours that differ more are a depth edge
constexpr int kEdgeMargin = 1;       // pixels so near to a depth edge are dropped
constexpr int kSpeckleSize = 60;     // pixels; smaller regions of like depth are dropped

/// Sets small regions and what is at a depth edge to NaN. `step`: 1/m from a plane to the next.
void remove_doubtful(double step, cv::Mat* inverse_depth) {
  const double units = kUnitsPerPlane / step;
  cv::Mat whole(inverse_depth->size(), CV_16SC1);
  for (int y = 0; y < whole.rows; ++y) {
    for (int x = 0; x < whole.cols; ++x) {
      const float value = inverse_depth->at<float>(y, x);
      whole.at<std::int16_t>(y, x) =
          std::isfinite(value) ? cv::saturate_cast<std::int16_t>(value * units) : std::int16_t{0};
    }
  }
  cv::filterSpeckles(whole, 0, kSpeckleSize, kJump * kUnitsPerPlane);
  const auto unknown = cv::Scalar(std::numeric_limits<float>::quiet_NaN());
  inverse_depth->setTo(unknown, whole == 0);
  inverse_depth->setTo(unknown, find_depth_edges(*inverse_depth / step, kJump, kEdgeMargin));
}

class Sweep {
 public:
  Sweep(const SweepNeighbours& neighbours, const SweepConfig& config, const SweepImage& reference)
      : neighbours_(neighbours),
        config_(config),
        reference_(reference),
        depths_{1.0 / config.max_depth_m, 1.0 / config.min_depth_m} {
    for (const SweepImage* other : neighbours.all()) {
      others_.push_back(other->small_view);
    }
  }

  SweepPlanes planes(const Eigen::Vector3d& normal, const InverseRange& distances) const {
    return space_planes(reference_.small_view,
                        others_,
                        normal,
                        distances,
                        depths_,
                        config_.plane_step_px,
                        config_.max_planes);
  }
  SweepPlanes facing_planes() const { return planes(Eigen::Vector3d::UnitZ(), depths_); }

  void add(const SweepPlanes& planes, SweepWinners* winners) const {
    const cv::Mat costs = sweep_costs(reference_, neighbours_, planes, depths_);
    winners->add(smooth_costs(costs, reference_.small_gray), planes);
  }

 private:
  const SweepNeighbours& neighbours_;
  const SweepConfig& config_;
  const SweepImage& reference_;
  InverseRange depths_;
  std::vector<View> others_;
};

}  // namespace

void sweep_image(const SweepNeighbours& neighbours,
                 const SweepConfig& config,
                 SceneDirections* directions,
                 SweepImage* reference,
                 SweepReport* report) {
  const Sweep sweep(neighbours, config, *reference);
  const SweepPlanes facing = sweep.facing_planes();
  report->directions = 0;
  report->planes = facing.inverse_distances.size();
  if (facing.inverse_distances.empty()) {
    reference->inverse_depth = cv::Mat(reference->small_gray.size(),
                                       CV_32FC1,
                                       cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
    return;
  }
  const double step = facing.inverse_distances[1] - facing.inverse_distances[0];
  SweepWinners winners(
      reference->small_gray.size(), reference->small_view.camera, kOtherDepth * step);
  sweep.add(facing, &winners);
  if (directions->empty() && config.max_directions > 0) {
    reference->inverse_depth = winners.inverse_depths(config.min_uniqueness);
    directions->add(*reference);
  }
  for (const PlaneDirection& direction :
       directions->strongest(reference->view, config.max_directions)) {
    const SweepPlanes planes = sweep.planes(direction.normal, direction.distances);
    if (!planes.inverse_distances.empty()) {
      sweep.add(planes, &winners);
      ++report->directions;
      report->planes += planes.inverse_distances.size();
    }
  }
  reference->inverse_depth = winners.inverse_depths(config.min_uniqueness);
  remove_doubtful(step, &reference->inverse_depth);
  directions->add(*reference);
}

}  // namespace facet_mapping::detail
