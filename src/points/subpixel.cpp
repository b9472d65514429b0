// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "subpixel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace facet_mapping::detail {
namespace {

constexpr int kRadius = 5;  // of the compared window, pixels
constexpr int kSide = 2 * kRadius + 1;
constexpr int kMostPixels = kSide * kSide;
constexpr int kLeastPixels = kMostPixels / 3;
constexpr int kSlantRadius = 8;       // of the window that the slant is measured in, pixels
constexpr int kSlantStep = 2;         // every second pixel of it tells enough
constexpr float kSameSurface = 1.5F;  // largest distance from the slanted plane, pixels
constexpr int kMostIterations = 3;
constexpr float kSmallChange = 0.05F;   // pixels; a smaller step ends the iteration
constexpr float kLargestChange = 1.0F;  // pixels; farther away is another minimum
constexpr float kLeastTexture = 4.0F;   // mean variance of the slope, squared grey values per pixel
constexpr float kLeastCorrelation = 0.5F;
constexpr float kDoubtPerPixel = 5.0F;   // doubt per pixel of the Cramer-Rao bound
constexpr float kUnrefinedDoubt = 1.3F;  // where the texture does not suffice
constexpr float kLostDoubt = 1.8F;       // where the iteration leads away

/// One value per pixel of a window.
using Values = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, kMostPixels, 1>;

/// Change of the disparity per pixel.
struct Slant {
  float along_x = 0.0F;
  float along_y = 0.0F;
};

/// Normal equations of a plane through the centre.
class SlantFit {
 public:
  void add(float dx, float dy, float difference) {
    xx_ += dx * dx;
    xy_ += dx * dy;
    yy_ += dy * dy;
    xd_ += dx * difference;
    yd_ += dy * difference;
  }

  Slant solve() const {
    const float determinant = xx_ * yy_ - xy_ * xy_;
    if (determinant < 1e-3F * (xx_ + yy_) * (xx_ + yy_)) {
      return {};  // pixels on a line say nothing across it
    }
    return {(yy_ * xd_ - xy_ * yd_) / determinant, (xx_ * yd_ - xy_ * xd_) / determinant};
  }

 private:
  float xx_ = 0.0F;
  float xy_ = 0.0F;
  float yy_ = 0.0F;
  float xd_ = 0.0F;
  float yd_ = 0.0F;
};

/// The offsets from `at` up to `radius` in steps that stay in [0, size).
cv::Range offsets_inside(int at, int radius, int step, int size) {
  const int before = std::min(radius, at / step * step);
  const int after = std::min(radius, (size - 1 - at) / step * step);
  return {-before, after + 1};
}

/// Slant of the disparities around `at` that may belong to the same surface.
Slant measure_slant(const cv::Mat& disparity, const cv::Point& at) {
  const auto center = disparity.at<float>(at);
  const cv::Range rows = offsets_inside(at.y, kSlantRadius, kSlantStep, disparity.rows);
  const cv::Range columns = offsets_inside(at.x, kSlantRadius, kSlantStep, disparity.cols);
  SlantFit fit;
  for (int dy = rows.start; dy < rows.end; dy += kSlantStep) {
    const float* row = disparity.ptr<float>(at.y + dy) + at.x;
    for (int dx = columns.start; dx < columns.end; dx += kSlantStep) {
      const float difference = row[dx] - center;
      if (std::abs(difference) < 2.0F * kSameSurface) {
        fit.add(static_cast<float>(dx), static_cast<float>(dy), difference);
      }
    }
  }
  return fit.solve();
}

/// Coefficients of a Catmull-Rom spline at every pixel of the window.
struct Spline {
  Values t;
  Values p0;
  Values p1;
  Values p2;
  Values p3;

  explicit Spline(Eigen::Index n) : t(n), p0(n), p1(n), p2(n), p3(n) {}

  Values value() const {
    const auto c1 = p2 - p0;
    const auto c2 = 2.0F * p0 - 5.0F * p1 + 4.0F * p2 - p3;
    const auto c3 = 3.0F * (p1 - p2) + p3 - p0;
    return p1 + 0.5F * t * (c1 + t * (c2 + t * c3));
  }

  Values slope() const {
    const auto c1 = p2 - p0;
    const auto c2 = 2.0F * p0 - 5.0F * p1 + 4.0F * p2 - p3;
    const auto c3 = 3.0F * (p1 - p2) + p3 - p0;
    return 0.5F * (c1 + t * (2.0F * c2 + 3.0F * t * c3));
  }
};

/// The pixels around one pixel of the left image that seem to lie on its surface.
class Window {
 public:
  Window(const cv::Mat& left, const cv::Mat& right, const cv::Mat& disparity, const cv::Point& at) {
    const auto center = disparity.at<float>(at);
    const Slant slant = measure_slant(disparity, at);
    left_values_.resize(kMostPixels);
    left_slopes_.resize(kMostPixels);
    // So far inside that the spline has its four pixels wherever the iteration goes.
    const float least_x = center + 1.0F + kLargestChange;
    const float most_x = center + static_cast<float>(right.cols - 3) - kLargestChange;
    const cv::Range rows = offsets_inside(at.y, kRadius, 1, left.rows);
    for (int y = at.y + rows.start; y < at.y + rows.end; ++y) {
      const float row_shift = slant.along_y * static_cast<float>(y - at.y);
      for (int x = std::max(at.x - kRadius, 1); x <= std::min(at.x + kRadius, left.cols - 2); ++x) {
        const float shift = row_shift + slant.along_x * static_cast<float>(x - at.x);
        const float right_x = static_cast<float>(x) - shift;
        if (std::abs(disparity.at<float>(y, x) - center - shift) < kSameSurface &&
            right_x >= least_x && right_x <= most_x) {
          add(left.ptr<std::uint8_t>(y) + x, right.ptr<std::uint8_t>(y), right_x);
        }
      }
    }
    left_values_.conservativeResize(count_);
    left_slopes_.conservativeResize(count_);
    if (count_ > 0) {
      left_values_ -= left_values_.mean();
    }
  }

  int count() const { return count_; }
  /// Less their mean.
  const Values& left_values() const { return left_values_; }
  const Values& left_slopes() const { return left_slopes_; }

  /// The right image at the window's pixels, shifted.
  Spline shifted(float disparity) const {
    Spline spline(count_);
    for (int i = 0; i < count_; ++i) {
      const float x = right_x_[i] - disparity;
      const int left = static_cast<int>(x);
      const std::uint8_t* pixels = right_rows_[i] + left - 1;
      spline.t[i] = x - static_cast<float>(left);
      spline.p0[i] = pixels[0];
      spline.p1[i] = pixels[1];
      spline.p2[i] = pixels[2];
      spline.p3[i] = pixels[3];
    }
    return spline;
  }

 private:
  void add(const std::uint8_t* left, const std::uint8_t* right_row, float right_x) {
    left_values_[count_] = left[0];
    left_slopes_[count_] = 0.5F * static_cast<float>(left[1] - left[-1]);
    right_rows_[count_] = right_row;
    right_x_[count_] = right_x;
    ++count_;
  }

  std::array<const std::uint8_t*, kMostPixels> right_rows_;
  std::array<float, kMostPixels> right_x_;  // at disparity 0, the slant applied
  Values left_values_;
  Values left_slopes_;
  int count_ = 0;
};

/// Centred, so that a difference of brightness does not count.
Values centered(Values values) {
  values -= values.mean();
  return values;
}

float correlation(const Values& a, const Values& b) {
  const float variances = a.square().sum() * b.square().sum();
  return variances > 0.0F ? (a * b).sum() / std::sqrt(variances) : 0.0F;
}

/// Doubt of a match from its Cramer-Rao bound (pixels) and the part of the window that was used;
/// fitted to LiDAR depth on KITTI streets.
float doubt_of(float bound_px, int used_pixels) {
  const float spread = kDoubtPerPixel * bound_px;
  const float shared = static_cast<float>(kMostPixels) / static_cast<float>(used_pixels);
  return std::sqrt(kLeastDoubt * kLeastDoubt + spread * spread) * shared * shared;
}

/// Gauss-Newton steps from `start`, where the right image's values are known.
RefinedDisparity iterate(const Window& window,
                         const Values& slopes,
                         Values right_values,
                         float start) {
  const float squares = slopes.square().sum();
  float refined = start;
  float residual = 0.0F;
  for (int i = 0; i < kMostIterations; ++i) {
    if (i > 0) {
      right_values = centered(window.shifted(refined).value());
    }
    const Values differences = right_values - window.left_values();
    residual = differences.square().mean();
    const float step = (slopes * differences).sum() / squares;
    refined += step;
    if (!(std::abs(refined - start) < kLargestChange)) {
      return {start, kLostDoubt};
    }
    if (std::abs(step) < kSmallChange) {
      break;
    }
  }
  return {refined, doubt_of(std::sqrt(residual / squares), window.count())};
}

}  // namespace

RefinedDisparity refine_disparity(const cv::Mat& left,
                                  const cv::Mat& right,
                                  const cv::Mat& disparity,
                                  const cv::Point& pixel) {
  const auto start = disparity.at<float>(pixel);
  const Window window(left, right, disparity, pixel);
  if (window.count() < kLeastPixels) {
    return {start, kUnrefinedDoubt};
  }
  const Spline spline = window.shifted(start);
  const Values right_values = centered(spline.value());
  // The mean slope of both images, which converges in few steps.
  const Values slopes = centered(0.5F * (window.left_slopes() + spline.slope()));
  if (slopes.square().mean() < kLeastTexture) {
    return {start, kUnrefinedDoubt};
  }
  if (correlation(window.left_values(), right_values) < kLeastCorrelation) {
    return {std::numeric_limits<float>::quiet_NaN(), kUnrefinedDoubt};
  }
  return iterate(window, slopes, right_values, start);
}

}  // namespace facet_mapping::detail
