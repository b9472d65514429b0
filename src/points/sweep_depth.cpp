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
#include <opencv2/imgproc.hpp>

namespace facet_mapping::detail {
namespace {

constexpr double kOtherDepth = 3.0;  // planes; so far apart two depths are not the same
constexpr int kUnitsPerPlane = 16;   // of the whole numbers that speckles are found in
constexpr double kJump = 2.5;        // planes; neighbours that differ more are a depth edge
constexpr int kEdgeMargin = 1;       // pixels so near to a depth edge are dropped
constexpr int kMedianSize = 3;       // pixels; evens out single planes
constexpr int kSpeckleSize = 60;     // pixels; smaller regions of like depth are dropped

/// CV_8UC1, non-zero in small regions of like depth. `planes`: inverse depths counted in planes.
cv::Mat find_speckles(const cv::Mat& planes) {
  cv::Mat whole;
  planes.convertTo(whole, CV_16SC1, kUnitsPerPlane);
  cv::filterSpeckles(whole, 0, kSpeckleSize, kJump * kUnitsPerPlane);
  return whole == 0;
}

/// The winners' depths, NaN where they are doubtful. `step`: 1/m from a plane to the next.
cv::Mat sure_depths(const SweepWinners& winners, double step, double min_uniqueness) {
  const cv::Scalar unknown(std::numeric_limits<float>::quiet_NaN());
  const cv::Mat unsure = winners.unsure(min_uniqueness);
  cv::Mat depths;
  cv::medianBlur(winners.inverse_depths(), depths, kMedianSize);
  const cv::Mat edges = find_depth_edges(depths / step, kJump, kEdgeMargin);
  depths.setTo(0.0, unsure);
  const cv::Mat speckles = find_speckles(depths / step);
  depths.setTo(unknown, unsure | edges | speckles);
  return depths;
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
    reference->inverse_depth = sure_depths(winners, step, config.min_uniqueness);
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
  reference->inverse_depth = sure_depths(winners, step, config.min_uniqueness);
  directions->add(*reference);
}

}  // namespace facet_mapping::detail
