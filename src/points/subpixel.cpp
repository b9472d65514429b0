// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "subpixel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace facet_mapping::detail {
namespace {

constexpr int kRadius = 5;  // of the compared window, pixels
constexpr int kSide = 2 * kRadius + 1;
constexpr int kSlantRadius = 8;       // of the window that the slant is measured in, pixels
constexpr int kSlantStep = 2;         // every second pixel of it tells enough
constexpr float kSameSurface = 1.5F;  // largest distance from the slanted plane, pixels
constexpr int kMostIterations = 3;
constexpr float kSmallChange = 0.02F;   // pixels; a smaller step ends the iteration
constexpr float kLargestChange = 1.0F;  // pixels; farther away is another minimum
constexpr float kLeastTexture = 4.0F;   // mean variance of the slope, squared grey values per pixel
constexpr float kLeastCorrelation = 0.5F;

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

/// Calls `visit(x, y, dx, dy)` for the pixels of a window that lie in the image.
template <typename Visit>
void for_window(
    const cv::Size& size, const cv::Point& at, int radius, int step, const Visit& visit) {
  for (int dy = -radius; dy <= radius; dy += step) {
    for (int dx = -radius; dx <= radius; dx += step) {
      const int x = at.x + dx;
      const int y = at.y + dy;
      if (x >= 0 && y >= 0 && x < size.width && y < size.height) {
        visit(x, y, static_cast<float>(dx), static_cast<float>(dy));
      }
    }
  }
}

/// Slant of the disparities around `at` that may belong to the same surface.
Slant measure_slant(const cv::Mat& disparity, const cv::Point& at) {
  const auto center = disparity.at<float>(at);
  SlantFit fit;
  for_window(disparity.size(), at, kSlantRadius, kSlantStep, [&](int x, int y, float dx, float dy) {
    const float difference = disparity.at<float>(y, x) - center;
    if (std::abs(difference) < 2.0F * kSameSurface) {
      fit.add(dx, dy, difference);
    }
  });
  return fit.solve();
}

struct Sample {
  float value;
  float slope;  // per pixel
};

/// Catmull-Rom spline along a row; the caller makes sure that x lies in [1, width - 2).
Sample sample_row(const std::uint8_t* row, float x) {
  const int left = static_cast<int>(x);
  const float t = x - static_cast<float>(left);
  const float p0 = row[left - 1];
  const float p1 = row[left];
  const float p2 = row[left + 1];
  const float p3 = row[left + 2];
  const float c1 = 0.5F * (p2 - p0);
  const float c2 = p0 - 2.5F * p1 + 2.0F * p2 - 0.5F * p3;
  const float c3 = 1.5F * (p1 - p2) + 0.5F * (p3 - p0);
  return {p1 + t * (c1 + t * (c2 + t * c3)), c1 + t * (2.0F * c2 + 3.0F * t * c3)};
}

/// Sums over the window that the step and the correlation come from. Grey values count from that of
/// the centre, so that floats are precise enough.
struct Sums {
  float n = 0.0F;
  float l = 0.0F;
  float r = 0.0F;
  float s = 0.0F;
  float ll = 0.0F;
  float rr = 0.0F;
  float lr = 0.0F;
  float ss = 0.0F;
  float ls = 0.0F;
  float rs = 0.0F;

  void add(float left, const Sample& right) {
    n += 1.0F;
    l += left;
    r += right.value;
    s += right.slope;
    ll += left * left;
    rr += right.value * right.value;
    lr += left * right.value;
    ss += right.slope * right.slope;
    ls += left * right.slope;
    rs += right.value * right.slope;
  }

  bool enough() const { return n >= kSide * kSide / 3; }
  float texture() const { return (ss - s * s / n) / n; }
  /// Gauss-Newton step of the disparity, the offset of brightness eliminated.
  float step() const { return ((rs - r * s / n) - (ls - l * s / n)) / (ss - s * s / n); }
  float correlation() const {
    const float variances = (ll - l * l / n) * (rr - r * r / n);
    return variances > 0.0F ? (lr - l * r / n) / std::sqrt(variances) : 0.0F;
  }
};

/// The pixels around one pixel of the left image that seem to lie on its surface.
class Window {
 public:
  Window(const cv::Mat& left, const cv::Mat& right, const cv::Mat& disparity, const cv::Point& at)
      : last_x_(static_cast<float>(right.cols - 2)) {
    const auto center = disparity.at<float>(at);
    center_value_ = left.at<std::uint8_t>(at);
    const Slant slant = measure_slant(disparity, at);
    for_window(left.size(), at, kRadius, 1, [&](int x, int y, float dx, float dy) {
      const float shift = slant.along_x * dx + slant.along_y * dy;
      if (std::abs(disparity.at<float>(y, x) - center - shift) < kSameSurface) {
        pixels_[count_++] = {right.ptr<std::uint8_t>(y),
                             static_cast<float>(x) - shift,
                             left.at<std::uint8_t>(y, x) - center_value_};
      }
    });
  }

  Sums sums(float disparity) const {
    Sums sums;
    for (int i = 0; i < count_; ++i) {
      const float x = pixels_[i].right_x - disparity;
      if (x >= 1.0F && x < last_x_) {
        const Sample sample = sample_row(pixels_[i].right_row, x);
        sums.add(pixels_[i].left_value, {sample.value - center_value_, sample.slope});
      }
    }
    return sums;
  }

 private:
  struct Pixel {
    const std::uint8_t* right_row;
    float right_x;  // at disparity 0, the slant applied
    float left_value;
  };

  std::array<Pixel, kSide * kSide> pixels_;
  int count_ = 0;
  float last_x_;
  float center_value_ = 0.0F;
};

}  // namespace

float refine_disparity(const cv::Mat& left,
                       const cv::Mat& right,
                       const cv::Mat& disparity,
                       const cv::Point& pixel) {
  const Window window(left, right, disparity, pixel);
  const auto start = disparity.at<float>(pixel);
  float refined = start;
  for (int i = 0; i < kMostIterations; ++i) {
    const Sums sums = window.sums(refined);
    if (!sums.enough() || sums.texture() < kLeastTexture) {
      return start;
    }
    if (i == 0 && sums.correlation() < kLeastCorrelation) {
      return std::numeric_limits<float>::quiet_NaN();
    }
    const float step = sums.step();
    refined += step;
    if (!(std::abs(refined - start) < kLargestChange)) {
      return start;
    }
    if (std::abs(step) < kSmallChange) {
      break;
    }
  }
  return refined;
}

}  // namespace facet_mapping::detail
