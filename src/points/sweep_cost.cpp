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

  /// The rows `begin` to `end` of the reference, from the other one's finer image.
  void warp(const cv::Mat& fine, const Eigen::Matrix3d& homography, int begin, int end) {
    for (int row = begin; row < end + 2 * kRadius; ++row) {
      find_places(fine.size(), homography.cast<float>(), row);
      sample(fine, gray_.ptr<Byte>(row));
    }
  }

  /// The pixel of the reference's row and column 0.
  const Byte* row(int y) const { return gray_.ptr<Byte>(y + kRadius) + kRadius; }
  /// 255 where the other image has the pixel.
  const Byte* seen(int y) const { return seen_.ptr<Byte>(y + kRadius) + kRadius; }
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(gray_.step); }

 private:
  /// The nearest pixels of the finer image, held within it.
  void find_places(const cv::Size& fine, const Eigen::Matrix3f& h, int row) {
    const auto y = static_cast<float>(row - kRadius);
    const float last_u = static_cast<float>(fine.width) - 0.5F;
    const float last_v = static_cast<float>(fine.height) - 0.5F;
    const float u0 = h(0, 1) * y + h(0, 2);
    const float v0 = h(1, 1) * y + h(1, 2);
    const float w0 = h(2, 1) * y + h(2, 2);
    const float hu = h(0, 0);
    const float hv = h(1, 0);
    const float hw = h(2, 0);
    Byte* seen = seen_.ptr<Byte>(row);
    int* us = u_.data();
    int* vs = v_.data();
    const int count = gray_.cols;
    for (int n = 0; n < count; ++n) {
      const auto x = static_cast<float>(n - kRadius);
      const float w = hw * x + w0;
      const float inverse = 1.0F / std::max(w, 0.05F);
      // Small pixel u has its centre at 2 u + 0.5 of the finer image; rounded to the nearest.
      const float u = 2.0F * (hu * x + u0) * inverse + 1.0F;
      const float v = 2.0F * (hv * x + v0) * inverse + 1.0F;
      const float inside_u = std::min(std::max(u, 0.0F), last_u);
      const float inside_v = std::min(std::max(v, 0.0F), last_v);
      const bool is_seen = (w > 0.05F) & (u == inside_u) & (v == inside_v);
      seen[n] = is_seen ? 255 : 0;
      us[n] = static_cast<int>(inside_u);
      vs[n] = static_cast<int>(inside_v);
    }
  }

  void sample(const cv::Mat& fine, Byte* to) const {
    const Byte* data = fine.data;
    const auto step = static_cast<int>(fine.step);
    const int* us = u_.data();
    const int* vs = v_.data();
    const int count = gray_.cols;
    for (int n = 0; n < count; ++n) {
      to[n] = data[vs[n] * step + us[n]];
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
    std::fill_n(costs, size_.area(), Byte{kLargestCost});
    const cv::Range rows = rows_in_range(plane, depths);
    const std::vector<WarpedImage> before = warp(neighbours_.before, plane, rows);
    const std::vector<WarpedImage> after = warp(neighbours_.after, plane, rows);
    SideCosts before_costs(size_.width);
    SideCosts after_costs(size_.width);
    std::vector<Byte> differing(static_cast<std::size_t>(size_.width));
    for (int y = rows.start; y < rows.end; ++y) {
      compare(before, y, &differing, &before_costs);
      compare(after, y, &differing, &after_costs);
      const PlaneRow inverse(*this, plane, y);
      Byte* row = costs + static_cast<std::ptrdiff_t>(y) * size_.width;
      for (int x = 0; x < size_.width; ++x) {
        const float least = std::min(before_costs.mean(x), after_costs.mean(x));
        const float cost = least > kBits ? kUnseenCost : least * kScale + 0.5F;
        row[x] = inverse.in_range(x, depths) ? static_cast<Byte>(cost) : Byte{kLargestCost};
      }
    }
  }

 private:
  /// The inverse depth changes evenly along a row.
  struct PlaneRow {
    float first;
    float step;

    PlaneRow(const PlaneSweep& sweep, const Eigen::Vector3d& plane, int y)
        : first(static_cast<float>(plane.dot(sweep.camera().ray({0, y})))),
          step(static_cast<float>(plane.x() / sweep.camera().fx)) {}

    bool in_range(int x, const InverseRange& depths) const {
      constexpr float kSlack = 1e-5F;  // share: the first and the last plane are in range
      const float inverse = first + step * static_cast<float>(x);
      return (inverse >= static_cast<float>(depths.low) * (1.0F - kSlack)) &
             (inverse <= static_cast<float>(depths.high) * (1.0F + kSlack));
    }
  };

  const PinholeCamera& camera() const { return reference_.small_view.camera; }

  /// Rows outside have no pixel in range.
  cv::Range rows_in_range(const Eigen::Vector3d& plane, const InverseRange& depths) const {
    cv::Range rows(0, 0);
    for (int y = 0; y < size_.height; ++y) {
      const double left = plane.dot(camera().ray({0, y}));
      const double right = plane.dot(camera().ray({size_.width - 1, y}));
      if (std::max(left, right) >= depths.low && std::min(left, right) <= depths.high) {
        rows.start = rows.empty() ? y : rows.start;
        rows.end = y + 1;
      }
    }
    return rows;
  }

  std::vector<WarpedImage> warp(const std::vector<const SweepImage*>& images,
                                const Eigen::Vector3d& plane,
                                const cv::Range& rows) const {
    std::vector<WarpedImage> warped;
    if (rows.empty()) {
      return warped;
    }
    for (const SweepImage* image : images) {
      warped.emplace_back(size_);
      warped.back().warp(image->fine_gray,
                         plane_homography(reference_.small_view, image->small_view, plane),
                         rows.start,
                         rows.end);
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
