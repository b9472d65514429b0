// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "epipolar_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace facet_mapping::detail {
namespace {

constexpr double kStepPx = 0.75;
constexpr int kMaxSteps = 2000;
constexpr double kOtherPeakPx = 2.5;  ///< a match so far from the best is another one
constexpr double kMinDepthRatio = 0.2;
constexpr float kMinContrast = 1.5F;  ///< standard deviation in grey values

double bilinear(const cv::Mat& gray, double x, double y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const double dx = x - column;
  const double dy = y - row;
  const auto* upper = gray.ptr<std::uint8_t>(row) + column;
  const auto* lower = gray.ptr<std::uint8_t>(row + 1) + column;
  return (1.0 - dy) * ((1.0 - dx) * upper[0] + dx * upper[1]) +
         dy * ((1.0 - dx) * lower[0] + dx * lower[1]);
}

/// Grey values of a square patch, of mean 0 and length 1.
class Patch {
 public:
  /// False if the patch leaves the image or is of one grey.
  bool sample(const cv::Mat& gray, const Eigen::Vector2d& centre, int radius, double scale) {
    const double reach = radius * scale;
    if (!(centre.x() >= reach && centre.y() >= reach && centre.x() + reach < gray.cols - 1 &&
          centre.y() + reach < gray.rows - 1)) {
      return false;
    }
    values_.clear();
    for (int y = -radius; y <= radius; ++y) {
      for (int x = -radius; x <= radius; ++x) {
        values_.push_back(
            static_cast<float>(bilinear(gray, centre.x() + scale * x, centre.y() + scale * y)));
      }
    }
    return normalize();
  }

  double likeness(const Patch& other) const {
    float sum = 0.0F;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      sum += values_[k] * other.values_[k];
    }
    return sum;
  }

 private:
  bool normalize() {
    float mean = 0.0F;
    for (const float value : values_) {
      mean += value;
    }
    mean /= static_cast<float>(values_.size());
    float squares = 0.0F;
    for (float& value : values_) {
      value -= mean;
      squares += value * value;
    }
    if (squares < kMinContrast * kMinContrast * static_cast<float>(values_.size())) {
      return false;
    }
    const float length = 1.0F / std::sqrt(squares);
    for (float& value : values_) {
      value *= length;
    }
    return true;
  }

  std::vector<float> values_;
};

struct Candidate {
  double inverse_depth = 0.0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double likeness = -1.0;
};

/// One search: the patch and where to look for it.
class Search {
 public:
  Search(const cv::Mat& gray, const EpipolarLine& line, int radius)
      : gray_(gray), line_(line), radius_(radius) {}

  bool start(const cv::Mat& gray_from, const Eigen::Vector2d& pixel) {
    return wanted_.sample(gray_from, pixel, radius_, 1.0);
  }

  Candidate at(double inverse_depth) {
    Candidate result{inverse_depth, line_.pixel(inverse_depth), -1.0};
    // What is nearer to the other camera is larger there.
    const double scale = 1.0 / line_.depth_ratio(inverse_depth);
    if (patch_.sample(gray_, result.pixel, radius_, scale)) {
      result.likeness = patch_.likeness(wanted_);
    }
    return result;
  }

  /// Candidates about a step apart, from far to near.
  std::vector<Candidate> along(const InverseDepthRange& range, const PinholeCamera& camera) {
    std::vector<Candidate> all;
    double inverse_depth = range.low;
    bool was_inside = false;
    for (int k = 0; k < kMaxSteps && inverse_depth <= range.high; ++k) {
      if (!(line_.depth_ratio(inverse_depth) > kMinDepthRatio)) {
        break;
      }
      all.push_back(at(inverse_depth));
      const double rate = line_.pixel_rate(inverse_depth).norm();
      const bool inside = camera.contains(all.back().pixel);
      if (!(rate > 0.0) || (was_inside && !inside)) {
        break;
      }
      was_inside = inside;
      inverse_depth += kStepPx / rate;
    }
    return all;
  }

  /// The top of the parabola through the best candidate and its neighbours `step_px` away.
  Candidate sharpen(const Candidate& best, double step_px) {
    const double rate = line_.pixel_rate(best.inverse_depth).norm();
    const double step = step_px / rate;
    if (!std::isfinite(step) || !(line_.depth_ratio(best.inverse_depth + step) > kMinDepthRatio)) {
      return best;
    }
    const double before = at(best.inverse_depth - step).likeness;
    const double after = at(best.inverse_depth + step).likeness;
    const double bend = before - 2.0 * best.likeness + after;
    if (before < -0.5 || after < -0.5 || !(bend < -1e-9)) {
      return best;
    }
    const double offset = std::clamp(0.5 * (before - after) / bend, -1.0, 1.0);
    const Candidate top = at(best.inverse_depth + offset * step);
    return top.likeness >= best.likeness ? top : best;
  }

 private:
  const cv::Mat& gray_;
  const EpipolarLine& line_;
  int radius_;
  Patch wanted_;
  Patch patch_;
};

const Candidate& best_of(const std::vector<Candidate>& candidates) {
  return *std::max_element(
      candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.likeness < b.likeness;
      });
}

bool is_unique(const std::vector<Candidate>& candidates, const Candidate& best, double margin) {
  return std::none_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
    return other.likeness > best.likeness - margin &&
           (other.pixel - best.pixel).norm() > kOtherPeakPx;
  });
}

}  // namespace

EpipolarLine::EpipolarLine(const View& from, const View& to, const Eigen::Vector2d& pixel)
    : camera_(to.camera) {
  const Eigen::Isometry3d to_from_from = to.cam_from_world() * from.world_from_cam;
  direction_ = to_from_from.linear() * from.camera.ray(pixel);
  shift_ = to_from_from.translation();
}

Eigen::Vector2d EpipolarLine::pixel(double inverse_depth) const {
  return camera_.project(direction_ + inverse_depth * shift_);
}

Eigen::Vector2d EpipolarLine::pixel_rate(double inverse_depth) const {
  return camera_.projection_jacobian(direction_ + inverse_depth * shift_) * shift_;
}

double EpipolarLine::distance(const Eigen::Vector2d& pixel_seen) const {
  const Eigen::Vector2d offset = pixel_seen - pixel(0.0);
  const Eigen::Vector2d rate = pixel_rate(0.0);
  const double length = rate.norm();
  if (!(length > 1e-9)) {
    return offset.norm();
  }
  return std::abs(rate.x() * offset.y() - rate.y() * offset.x()) / length;
}

EpipolarMatch search_epipolar(const cv::Mat& gray_from,
                              const Eigen::Vector2d& pixel,
                              const cv::Mat& gray_to,
                              const EpipolarLine& line,
                              const PinholeCamera& camera_to,
                              const InverseDepthRange& range,
                              const EpipolarSearchConfig& config) {
  Search search(gray_to, line, config.patch_radius_px);
  EpipolarMatch match;
  if (!search.start(gray_from, pixel)) {
    return match;
  }
  const std::vector<Candidate> candidates = search.along(range, camera_to);
  if (candidates.empty()) {
    return match;
  }
  const Candidate& coarse = best_of(candidates);
  if (coarse.likeness < 0.8 * config.min_likeness) {
    return match;
  }
  const Candidate best = search.sharpen(search.sharpen(coarse, kStepPx), 0.4);
  if (best.likeness < config.min_likeness) {
    return match;
  }
  const bool unique = is_unique(candidates, best, config.min_uniqueness);
  match.kind = unique ? EpipolarMatch::Kind::kFound : EpipolarMatch::Kind::kAmbiguous;
  match.inverse_depth = best.inverse_depth;
  match.pixel = best.pixel;
  match.likeness = best.likeness;
  return match;
}

}  // namespace facet_mapping::detail
