// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/sweep_points.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "sweep_checks.h"
#include "sweep_depth.h"
#include "sweep_directions.h"
#include "sweep_neighbours.h"
#include "sweep_output.h"
#include "track_checks.h"
#include <opencv2/imgproc.hpp>

#include "facet_mapping/geometry/median.h"

namespace facet_mapping {
namespace {

using detail::SweepImage;
using detail::SweepNeighbours;

SweepImage make_image(
    const cv::Mat& gray, const View& view, const cv::Mat& labels, double stamp, int widest_px) {
  SweepImage image{view, gray.clone(), labels.clone(), stamp, view, {}, {}, {}};
  cv::Size size = gray.size();
  while (size.width > widest_px && size.height >= 2) {
    size = {(size.width + 1) / 2, (size.height + 1) / 2};
  }
  image.small_view.camera = view.camera.resized(size.width, size.height);
  cv::resize(image.gray, image.small_gray, size, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(image.small_gray, image.fine_gray, size * 2, 0.0, 0.0, cv::INTER_LINEAR);
  return image;
}

/// NaN if the image has no depth.
double median_depth(const cv::Mat& inverse_depth) {
  std::vector<float> values;
  std::copy_if(inverse_depth.begin<float>(),
               inverse_depth.end<float>(),
               std::back_inserter(values),
               [](float value) { return value > 0.0F; });
  if (values.empty()) {
    return std::nan("");
  }
  return 1.0 / median(std::move(values));
}

}  // namespace

class PlaneSweeper::State {
 public:
  explicit State(SweepConfig config) : config_(std::move(config)) { forget(); }

  std::vector<PointFrame> add(const cv::Mat& gray,
                              const View& view,
                              const cv::Mat& labels,
                              double stamp,
                              SweepReport* report) {
    std::vector<PointFrame> frames;
    if (!images_.empty()) {
      const SweepImage& last = images_.back();
      if (gray.size() != last.gray.size() || stamp < last.stamp) {
        frames = finish(report);
        report->restarted = true;
      } else if (!detail::has_moved(last.view, view, depth_m_, config_)) {
        report->still = true;
        return frames;
      }
    }
    images_.push_back(make_image(gray, view, labels, stamp, config_.sweep_width_px));
    report->used = true;
    const auto window = static_cast<std::size_t>(config_.window);
    while (swept_ + window < images_.size()) {
      sweep(report);
    }
    while (released_ + window < swept_) {
      release(&frames, report);
    }
    forget_oldest();
    return frames;
  }

  std::vector<PointFrame> finish(SweepReport* report) {
    std::vector<PointFrame> frames;
    while (swept_ < images_.size()) {
      sweep(report);
    }
    while (released_ < swept_) {
      release(&frames, report);
    }
    forget();
    return frames;
  }

 private:
  void sweep(SweepReport* report) {
    SweepImage& reference = images_[swept_];
    const SweepNeighbours neighbours = neighbours_of(swept_);
    if (neighbours.empty()) {
      ++report->alone;
    } else {
      ++report->swept;
      detail::sweep_image(neighbours, config_, &directions_, &reference, report);
      const double depth = median_depth(reference.inverse_depth);
      depth_m_ = std::isfinite(depth) ? depth : depth_m_;
    }
    ++swept_;
  }

  void release(std::vector<PointFrame>* frames, SweepReport* report) {
    const SweepImage& reference = images_[released_];
    if (!reference.inverse_depth.empty()) {
      const std::vector<const SweepImage*> compared = neighbours_of(released_).all();
      std::vector<const SweepImage*> checked;
      std::copy_if(compared.begin(),
                   compared.end(),
                   std::back_inserter(checked),
                   [](const SweepImage* image) { return !image->inverse_depth.empty(); });
      PointFrame frame{reference.stamp, reference.view.world_from_cam, {}};
      frame.points = detail::swept_points(reference, compared, checked, config_, report);
      if (!frame.points.empty()) {
        frames->push_back(std::move(frame));
      }
    }
    ++released_;
  }

  SweepNeighbours neighbours_of(std::size_t index) const {
    return detail::find_neighbours(images_, index, depth_m_, config_);
  }

  void forget_oldest() {
    while (released_ > static_cast<std::size_t>(config_.window)) {
      images_.pop_front();
      --released_;
      --swept_;
    }
  }

  void forget() {
    images_.clear();
    directions_.clear();
    swept_ = 0;
    released_ = 0;
    depth_m_ = std::sqrt(config_.min_depth_m * config_.max_depth_m);
  }

  SweepConfig config_;
  std::deque<SweepImage> images_;  // used ones, oldest first
  std::size_t swept_ = 0;          // how many of them are swept
  std::size_t released_ = 0;       // ... and have given their points
  double depth_m_ = 0.0;           // median of the last swept image
  detail::SceneDirections directions_;
};

PlaneSweeper::PlaneSweeper(const SweepConfig& config) {
  detail::check_sweep_config(config);
  state_ = std::make_unique<State>(config);
}

PlaneSweeper::~PlaneSweeper() = default;
PlaneSweeper::PlaneSweeper(PlaneSweeper&&) noexcept = default;
PlaneSweeper& PlaneSweeper::operator=(PlaneSweeper&&) noexcept = default;

std::vector<PointFrame> PlaneSweeper::add(const cv::Mat& gray,
                                          const View& view,
                                          const cv::Mat& labels,
                                          double stamp,
                                          SweepReport* report) {
  SweepReport own;
  SweepReport& counts = report != nullptr ? *report : own;
  counts = {};
  detail::check_track_image(gray, view.camera, labels);
  if (!is_rigid(view.world_from_cam) || !std::isfinite(stamp)) {
    counts.bad_pose = true;
    return {};
  }
  return state_->add(gray, view, labels, stamp, &counts);
}

std::vector<PointFrame> PlaneSweeper::finish(SweepReport* report) {
  SweepReport own;
  SweepReport& counts = report != nullptr ? *report : own;
  counts = {};
  return state_->finish(&counts);
}

}  // namespace facet_mapping
