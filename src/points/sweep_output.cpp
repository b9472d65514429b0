// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_output.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "excluded_labels.h"
#include "pixel_thinning.h"
#include "sweep_agreement.h"
#include "sweep_refine.h"
#include <tbb/parallel_for.h>

namespace facet_mapping::detail {
namespace {

class Output {
 public:
  Output(const SweepImage& reference, const SweepConfig& config, SweepReport* report)
      : reference_(reference),
        config_(config),
        report_(report),
        scale_(static_cast<double>(reference.small_gray.cols) / reference.gray.cols) {}

  std::vector<LabeledPoint> run(const std::vector<const SweepImage*>& compared,
                                const std::vector<const SweepImage*>& checked) {
    precision_ = depth_precision(reference_, compared);
    const std::vector<cv::Point> pixels =
        thin_pixels(find_usable(checked),
                    gradient_magnitude(reference_.gray),
                    {config_.cell_px, config_.flat_cell_px, config_.min_gradient});
    std::vector<RefinedDepth> refined(pixels.size());
    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t k) {
      refined[k] = refine_depth(reference_, compared, patch_at(pixels[k]));
    });
    std::vector<LabeledPoint> points;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      add_point(pixels[k], refined[k], &points);
    }
    report_->points += points.size();
    return points;
  }

 private:
  cv::Point small_pixel(const cv::Point& pixel) const {
    return {std::min(static_cast<int>((pixel.x + 0.5) * scale_), precision_.cols - 1),
            std::min(static_cast<int>((pixel.y + 0.5) * scale_), precision_.rows - 1)};
  }

  /// sigma(z) / z = z * sigma(1 / z); the precision counts in pixels of the given scale.
  double relative_sigma(double inverse_depth, double precision, double scale) const {
    return config_.pixel_sigma * scale / (precision * inverse_depth);
  }

  /// Non-zero, at full size, where a pixel may become a point.
  cv::Mat find_usable(const std::vector<const SweepImage*>& checked) {
    const int needed = std::min(config_.min_agreeing, static_cast<int>(checked.size()));
    const cv::Mat agreeing =
        find_agreeing(reference_, checked, precision_, config_.max_disagreement_px, needed);
    cv::Mat small(agreeing.size(), CV_8UC1);
    for (int y = 0; y < small.rows; ++y) {
      for (int x = 0; x < small.cols; ++x) {
        small.at<std::uint8_t>(y, x) = is_usable({x, y}, agreeing) ? 255 : 0;
      }
    }
    return enlarge(small);
  }

  bool is_usable(const cv::Point& small, const cv::Mat& agreeing) const {
    const double inverse = reference_.inverse_depth.at<float>(small);
    ++report_->pixels;
    if (!(inverse > 0.0)) {
      ++report_->unsure;
      return false;
    }
    if (!(relative_sigma(inverse, precision_.at<float>(small), scale_) <=
          config_.max_relative_sigma)) {
      ++report_->imprecise;
      return false;
    }
    if (!in_range(1.0 / inverse)) {
      ++report_->out_of_range;
      return false;
    }
    if (agreeing.at<std::uint8_t>(small) == 0) {
      ++report_->inconsistent;
      return false;
    }
    return true;
  }

  cv::Mat enlarge(const cv::Mat& small) const {
    cv::Mat usable(reference_.gray.size(), CV_8UC1);
    for (int y = 0; y < usable.rows; ++y) {
      for (int x = 0; x < usable.cols; ++x) {
        const bool is_kept =
            reference_.labels.empty() ||
            !is_excluded(reference_.labels.at<Label>(y, x), config_.excluded_labels);
        usable.at<std::uint8_t>(y, x) =
            is_kept ? small.at<std::uint8_t>(small_pixel({x, y})) : std::uint8_t{0};
      }
    }
    return usable;
  }

  SurfacePatch patch_at(const cv::Point& pixel) const {
    const cv::Point small = small_pixel(pixel);
    const Eigen::Vector2d aside((pixel.x + 0.5) * scale_ - 0.5 - small.x,
                                (pixel.y + 0.5) * scale_ - 0.5 - small.y);
    const double tolerance = 3.0 / precision_.at<float>(small);
    const Eigen::Vector2d slant = measure_slant(reference_.inverse_depth, small, tolerance);
    return {{pixel.x, pixel.y},
            reference_.inverse_depth.at<float>(small) + slant.dot(aside),
            slant * scale_};
  }

  bool in_range(double depth) const {
    return depth >= config_.min_depth_m && depth <= config_.max_depth_m;
  }

  void add_point(const cv::Point& pixel,
                 const RefinedDepth& refined,
                 std::vector<LabeledPoint>* points) {
    if (!(refined.likeness >= config_.min_likeness && refined.inverse_depth > 0.0)) {
      ++report_->unlike;
      return;
    }
    const double depth = 1.0 / refined.inverse_depth;
    const double relative = relative_sigma(refined.inverse_depth, refined.precision, 1.0);
    if (!(relative <= config_.max_relative_sigma)) {
      ++report_->imprecise;
      return;
    }
    if (!in_range(depth)) {
      ++report_->out_of_range;
      return;
    }
    const Eigen::Vector3d ray = reference_.view.camera.ray({pixel.x, pixel.y});
    LabeledPoint point;
    point.position = (depth * ray).cast<float>();
    point.label = reference_.labels.empty() ? kUnlabelled : reference_.labels.at<Label>(pixel);
    point.sigma = static_cast<float>(relative * depth * ray.norm());
    points->push_back(point);
  }

  const SweepImage& reference_;
  const SweepConfig& config_;
  SweepReport* report_;
  double scale_;  // pixels as swept per pixel at full size
  cv::Mat precision_;
};

}  // namespace

std::vector<LabeledPoint> swept_points(const SweepImage& reference,
                                       const std::vector<const SweepImage*>& compared,
                                       const std::vector<const SweepImage*>& checked,
                                       const SweepConfig& config,
                                       SweepReport* report) {
  return Output(reference, config, report).run(compared, checked);
}

}  // namespace facet_mapping::detail
