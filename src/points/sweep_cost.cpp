// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>
#include <tbb/parallel_for.h>

namespace facet_mapping::detail {
namespace {

using Byte = std::uint8_t;

constexpr int kRadius = 2;  // of the census window, pixels
constexpr int kBits = (2 * kRadius + 1) * (2 * kRadius + 1) - 1;
constexpr int kScale = kLargestCost / kBits;
/// Where no image sees the plane nothing speaks for or against it.
constexpr Byte kUnseenCost = 48;
constexpr int kSubpixelBits = 5;
constexpr int kSubpixels = 1 << kSubpixelBits;

/// Pixel of the other image for each pixel of the reference, on one plane.
Eigen::Matrix3d plane_homography(const View& from, const View& to, const Eigen::Vector3d& plane) {
  const RayMotion motion(from, to);
  const PinholeCamera& c = from.camera;
  const PinholeCamera& d = to.camera;
  Eigen::Matrix3d ray_from_pixel;
  ray_from_pixel << 1.0 / c.fx, 0.0, -c.cx / c.fx, 0.0, 1.0 / c.fy, -c.cy / c.fy, 0.0, 0.0, 1.0;
  Eigen::Matrix3d pixel_from_point;
  pixel_from_point << d.fx, 0.0, d.cx, 0.0, d.fy, d.cy, 0.0, 0.0, 1.0;
  return pixel_from_point * (motion.rotation + motion.shift * plane.transpose()) * ray_from_pixel;
}

/// An image as the reference would see it if it were of one plane, with a border of kRadius.
class WarpedImage {
 public:
  explicit WarpedImage(const cv::Size& size)
      : gray_(size.height + 2 * kRadius, size.width + 2 * kRadius, CV_8UC1),
        seen_(gray_.size(), CV_8UC1),
        u_(static_cast<std::size_t>(gray_.cols)),
        v_(u_.size()) {}

  void warp(const cv::Mat& from, const Eigen::Matrix3d& homography) {
    for (int row = 0; row < gray_.rows; ++row) {
      find_places(from.size(), homography.cast<float>(), row);
      sample(from, gray_.ptr<Byte>(row));
    }
  }

  /// The pixel of the reference's row and column 0.
  const Byte* row(int y) const { return gray_.ptr<Byte>(y + kRadius) + kRadius; }
  /// 255 where the other image has the pixel.
  const Byte* seen(int y) const { return seen_.ptr<Byte>(y + kRadius) + kRadius; }
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(gray_.step); }

 private:
  /// In units of 1 / kSubpixels pixels, held within the image.
  void find_places(const cv::Size& size, const Eigen::Matrix3f& h, int row) {
    const auto y = static_cast<float>(row - kRadius);
    const float last_u = static_cast<float>(size.width) - 1.04F;
    const float last_v = static_cast<float>(size.height) - 1.04F;
    const float u0 = h(0, 1) * y + h(0, 2);
    const float v0 = h(1, 1) * y + h(1, 2);
    const float w0 = h(2, 1) * y + h(2, 2);
    const float hu = h(0, 0);
    const float hv = h(1, 0);
    const float hw = h(2, 0);
    Byte* seen = seen_.ptr<Byte>(row);
    const int count = gray_.cols;
    for (int n = 0; n < count; ++n) {
      const auto x = static_cast<float>(n - kRadius);
      const float w = hw * x + w0;
      const float inverse = 1.0F / std::max(w, 0.05F);
      const float u = (hu * x + u0) * inverse;
      const float v = (hv * x + v0) * inverse;
      const float inside_u = std::min(std::max(u, 0.0F), last_u);
      const float inside_v = std::min(std::max(v, 0.0F), last_v);
      const bool is_seen = (w > 0.05F) & (u == inside_u) & (v == inside_v);
      seen[n] = is_seen ? 255 : 0;
      u_[n] = static_cast<int>(inside_u * kSubpixels);
      v_[n] = static_cast<int>(inside_v * kSubpixels);
    }
  }

  void sample(const cv::Mat& from, Byte* to) const {
    for (int n = 0; n < gray_.cols; ++n) {
      const int a = u_[n] & (kSubpixels - 1);
      const int b = v_[n] & (kSubpixels - 1);
      const Byte* upper = from.ptr<Byte>(v_[n] >> kSubpixelBits) + (u_[n] >> kSubpixelBits);
      const Byte* lower = upper + from.step;
      const int top = upper[0] * kSubpixels + a * (upper[1] - upper[0]);
      const int bottom = lower[0] * kSubpixels + a * (lower[1] - lower[0]);
      to[n] = static_cast<Byte>((top * kSubpixels + b * (bottom - top)) >> (2 * kSubpixelBits));
    }
  }

  cv::Mat gray_;
  cv::Mat seen_;
  std::vector<int> u_;
  std::vector<int> v_;
};

/// Bits that differ between the census windows of two rows.
void compare_census(const Byte* a,
                    std::ptrdiff_t stride_a,
                    const Byte* b,
                    std::ptrdiff_t stride_b,
                    int width,
                    Byte* differing) {
  std::fill(differing, differing + width, Byte{0});
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      const Byte* near_a = a + dy * stride_a + dx;
      const Byte* near_b = b + dy * stride_b + dx;
      for (int x = 0; x < width; ++x) {
        const Byte larger_a = near_a[x] > a[x] ? 1 : 0;
        const Byte larger_b = near_b[x] > b[x] ? 1 : 0;
        differing[x] = static_cast<Byte>(differing[x] + (larger_a ^ larger_b));
      }
    }
  }
}

/// Mean over the images of one side, where they see the pixel.
class SideCosts {
 public:
  explicit SideCosts(int width) : sum_(static_cast<std::size_t>(width)), count_(sum_.size()) {}

  void clear() {
    std::fill(sum_.begin(), sum_.end(), std::int16_t{0});
    std::fill(count_.begin(), count_.end(), std::int16_t{0});
  }

  void add(const Byte* differing, const Byte* seen) {
    for (std::size_t x = 0; x < sum_.size(); ++x) {
      sum_[x] = static_cast<std::int16_t>(sum_[x] + (differing[x] & seen[x]));
      count_[x] = static_cast<std::int16_t>(count_[x] + (seen[x] & 1));
    }
  }

  float mean(std::size_t x) const {
    return count_[x] > 0 ? static_cast<float>(sum_[x]) / static_cast<float>(count_[x]) : 1e3F;
  }

 private:
  std::vector<std::int16_t> sum_;
  std::vector<std::int16_t> count_;
};

/// All costs of one plane.
class PlaneSweep {
 public:
  PlaneSweep(const SweepImage& reference, const SweepNeighbours& neighbours)
      : reference_(reference), size_(reference.small_gray.size()), neighbours_(neighbours) {
    cv::copyMakeBorder(reference.small_gray,
                       padded_,
                       kRadius,
                       kRadius,
                       kRadius,
                       kRadius,
                       cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  }

  void sweep(const Eigen::Vector3d& plane, const InverseRange& depths, Byte* costs) const {
    const std::vector<WarpedImage> before = warp(neighbours_.before, plane);
    const std::vector<WarpedImage> after = warp(neighbours_.after, plane);
    SideCosts before_costs(size_.width);
    SideCosts after_costs(size_.width);
    std::vector<Byte> differing(static_cast<std::size_t>(size_.width));
    for (int y = 0; y < size_.height; ++y) {
      compare(before, y, &differing, &before_costs);
      compare(after, y, &differing, &after_costs);
      Byte* row = costs + static_cast<std::ptrdiff_t>(y) * size_.width;
      for (int x = 0; x < size_.width; ++x) {
        const float least = std::min(before_costs.mean(x), after_costs.mean(x));
        row[x] = least > kBits ? kUnseenCost : static_cast<Byte>(least * kScale + 0.5F);
      }
      refuse_out_of_range(plane, depths, y, row);
    }
  }

 private:
  std::vector<WarpedImage> warp(const std::vector<const SweepImage*>& images,
                                const Eigen::Vector3d& plane) const {
    std::vector<WarpedImage> warped;
    for (const SweepImage* image : images) {
      warped.emplace_back(size_);
      warped.back().warp(image->small_gray,
                         plane_homography(reference_.small_view, image->small_view, plane));
    }
    return warped;
  }

  void compare(const std::vector<WarpedImage>& images,
               int y,
               std::vector<Byte>* differing,
               SideCosts* costs) const {
    costs->clear();
    const auto stride = static_cast<std::ptrdiff_t>(padded_.step);
    const Byte* row = padded_.ptr<Byte>(y + kRadius) + kRadius;
    for (const WarpedImage& image : images) {
      compare_census(row, stride, image.row(y), image.stride(), size_.width, differing->data());
      costs->add(differing->data(), image.seen(y));
    }
  }

  void refuse_out_of_range(const Eigen::Vector3d& plane,
                           const InverseRange& depths,
                           int y,
                           Byte* row) const {
    constexpr double kSlack = 1e-9;
    for (int x = 0; x < size_.width; ++x) {
      const double inverse = plane.dot(reference_.small_view.camera.ray({x, y}));
      if (inverse < depths.low - kSlack || inverse > depths.high + kSlack) {
        row[x] = kLargestCost;
      }
    }
  }

  const SweepImage& reference_;
  cv::Size size_;
  const SweepNeighbours& neighbours_;
  cv::Mat padded_;
};

}  // namespace

cv::Mat sweep_costs(const SweepImage& reference,
                    const SweepNeighbours& neighbours,
                    const SweepPlanes& planes,
                    const InverseRange& depths) {
  const PlaneSweep sweep(reference, neighbours);
  const int count = static_cast<int>(planes.inverse_distances.size());
  cv::Mat by_plane(count, static_cast<int>(reference.small_gray.total()), CV_8UC1);
  tbb::parallel_for(0, count, [&](int k) {
    sweep.sweep(planes.inverse_distances[static_cast<std::size_t>(k)] * planes.normal,
                depths,
                by_plane.ptr<Byte>(k));
  });
  cv::Mat by_pixel;
  cv::transpose(by_plane, by_pixel);
  return by_pixel;
}

}  // namespace facet_mapping::detail
