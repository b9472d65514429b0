// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sweep_planes.h"
#include <tbb/parallel_for.h>

namespace facet_mapping::detail {
namespace {

/// A surface seen farther away by more than this many tolerances lies behind the point.
constexpr double kThrough = 3.0;

/// The inverse depth that another image has where it sees the point; NaN if it has none.
float depth_there(const SweepImage& other, const Eigen::Vector3d& in_other) {
  const PinholeCamera& camera = other.small_view.camera;
  if (in_other.z() > 0.0) {
    const Eigen::Vector2d pixel = camera.project(in_other);
    if (camera.contains(pixel)) {
      return other.inverse_depth.at<float>(static_cast<int>(std::lround(pixel.y())),
                                           static_cast<int>(std::lround(pixel.x())));
    }
  }
  return std::numeric_limits<float>::quiet_NaN();
}

class Agreement {
 public:
  Agreement(const SweepImage& reference, const std::vector<const SweepImage*>& others)
      : camera_(reference.small_view.camera), others_(others) {
    motions_.reserve(others.size());
    for (const SweepImage* other : others) {
      motions_.emplace_back(reference.small_view, other->small_view);
    }
  }

  bool holds(const Eigen::Vector2d& pixel,
             double inverse_depth,
             double tolerance,
             int min_agreeing) const {
    const Eigen::Vector3d ray = camera_.ray(pixel);
    int agreeing = 0;
    int through = 0;
    for (std::size_t k = 0; k < others_.size(); ++k) {
      const Eigen::Vector3d in_other = motions_[k].at(ray, inverse_depth) / inverse_depth;
      const double there = depth_there(*others_[k], in_other);
      // The other's inverse depth, as one of the reference: near enough for small differences.
      const double scale = inverse_depth * in_other.z();
      const double difference = (there - 1.0 / in_other.z()) * scale * scale;
      agreeing += std::abs(difference) <= tolerance ? 1 : 0;
      through += difference < -kThrough * tolerance ? 1 : 0;
    }
    return agreeing >= min_agreeing && agreeing > through;
  }

 private:
  PinholeCamera camera_;
  const std::vector<const SweepImage*>& others_;
  std::vector<RayMotion> motions_;
};

}  // namespace

cv::Mat depth_precision(const SweepImage& reference, const std::vector<const SweepImage*>& others) {
  std::vector<RayMotion> motions;
  motions.reserve(others.size());
  for (const SweepImage* other : others) {
    motions.emplace_back(reference.small_view, other->small_view);
  }
  cv::Mat precision(reference.inverse_depth.size(), CV_32FC1, cv::Scalar(0));
  tbb::parallel_for(0, precision.rows, [&](int y) {
    for (int x = 0; x < precision.cols; ++x) {
      const double inverse = reference.inverse_depth.at<float>(y, x);
      if (!(inverse > 0.0)) {
        continue;
      }
      const Eigen::Vector3d ray = reference.small_view.camera.ray({x, y});
      double squares = 0.0;
      int seen = 0;
      for (std::size_t k = 0; k < others.size(); ++k) {
        const double rate = pixel_rate(motions[k], others[k]->small_view.camera, ray, inverse);
        squares += rate * rate;
        seen += rate > 0.0 ? 1 : 0;
      }
      const double worth = std::min(1.0, 2.0 / std::max(seen, 1));
      precision.at<float>(y, x) = static_cast<float>(std::sqrt(squares * worth));
    }
  });
  return precision;
}

cv::Mat find_agreeing(const SweepImage& reference,
                      const std::vector<const SweepImage*>& others,
                      const cv::Mat& precision,
                      double max_px,
                      int min_agreeing) {
  const Agreement agreement(reference, others);
  cv::Mat agreeing(reference.inverse_depth.size(), CV_8UC1, cv::Scalar(0));
  tbb::parallel_for(0, agreeing.rows, [&](int y) {
    for (int x = 0; x < agreeing.cols; ++x) {
      const double inverse = reference.inverse_depth.at<float>(y, x);
      const double exact = precision.at<float>(y, x);
      if (inverse > 0.0 && exact > 0.0 &&
          agreement.holds(Eigen::Vector2d(x, y), inverse, max_px / exact, min_agreeing)) {
        agreeing.at<std::uint8_t>(y, x) = 255;
      }
    }
  });
  return agreeing;
}

}  // namespace facet_mapping::detail
