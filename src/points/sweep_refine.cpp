// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "sweep_planes.h"
#include <Eigen/LU>

namespace facet_mapping::detail {
namespace {

constexpr int kRadius = 4;  // of the compared patch, pixels
constexpr int kSide = 2 * kRadius + 1;
constexpr int kArea = kSide * kSide;
constexpr int kSlantRadius = 5;         // of the window that the slant is measured in, pixels
constexpr int kMostIterations = 3;      // before and after hidden images are left out
constexpr double kSmallChange = 0.02;   // pixels; a smaller step ends the iteration
constexpr double kLargestChange = 2.5;  // pixels; farther away is another minimum
constexpr float kLeastContrast = 1.5F;  // standard deviation of a patch, grey values
constexpr float kNoContrast = 0.5F;     // as of a saturated sky: there depths are guesses
constexpr float kUnlike = 0.3F;         // correlation; such images do not show the patch ...
constexpr float kLessLike = 0.2F;       // ... nor those that are less like it by this
constexpr double kFlatPrecision = 0.5;  // of a depth that the texture does not refine
constexpr float kHalf = 0.5F;           // pixels to either side that the slope is measured over

using Values = std::array<float, kArea>;

/// Makes the mean 0 and the length 1 and returns the former length.
float normalize(Values* values) {
  float mean = 0.0F;
  for (const float value : *values) {
    mean += value;
  }
  mean /= kArea;
  float squares = 0.0F;
  for (float& value : *values) {
    value -= mean;
    squares += value * value;
  }
  const float length = std::sqrt(squares);
  if (length > 0.0F) {
    for (float& value : *values) {
      value /= length;
    }
  }
  return length;
}

float dot(const Values& a, const Values& b) {
  float sum = 0.0F;
  for (int k = 0; k < kArea; ++k) {
    sum += a[k] * b[k];
  }
  return sum;
}

float bilinear(const cv::Mat& gray, float x, float y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const float a = x - static_cast<float>(column);
  const float b = y - static_cast<float>(row);
  const auto* upper = gray.ptr<std::uint8_t>(row) + column;
  const auto* lower = upper + gray.step;
  const float top = static_cast<float>(upper[0]) + a * static_cast<float>(upper[1] - upper[0]);
  const float bottom = static_cast<float>(lower[0]) + a * static_cast<float>(lower[1] - lower[0]);
  return top + b * (bottom - top);
}

/// The patch in one other image.
class OtherImage {
 public:
  OtherImage(const SweepImage& reference, const SweepImage& other, const SurfacePatch& patch)
      : gray_(other.gray), camera_(other.view.camera) {
    const RayMotion motion(reference.view, other.view);
    const PinholeCamera& camera = reference.view.camera;
    shift_ = motion.shift;
    ray_ = motion.rotation * camera.ray(patch.pixel);
    per_x_ = motion.rotation.col(0) / camera.fx + patch.slant.x() * shift_;
    per_y_ = motion.rotation.col(1) / camera.fy + patch.slant.y() * shift_;
  }

  /// False if the image does not have the whole patch.
  bool sample(double inverse_depth) {
    const Eigen::Vector3d middle = ray_ + inverse_depth * shift_;
    if (!(middle.z() > 0.05)) {
      return false;
    }
    rate_ = camera_.projection_jacobian(middle) * shift_;
    if (!(rate_.norm() > 1e-6)) {
      return false;
    }
    const Eigen::Vector2f half = (kHalf * rate_.normalized()).cast<float>();
    int k = 0;
    for (int y = -kRadius; y <= kRadius; ++y) {
      for (int x = -kRadius; x <= kRadius; ++x, ++k) {
        const Eigen::Vector3d at = middle + x * per_x_ + y * per_y_;
        if (!(at.z() > 0.05)) {
          return false;
        }
        const Eigen::Vector2f pixel = camera_.project(at).cast<float>();
        if (!(pixel.x() >= 1.0F && pixel.y() >= 1.0F &&
              pixel.x() < static_cast<float>(gray_.cols - 2) &&
              pixel.y() < static_cast<float>(gray_.rows - 2))) {
          return false;
        }
        const float up = bilinear(gray_, pixel.x() + half.x(), pixel.y() + half.y());
        const float down = bilinear(gray_, pixel.x() - half.x(), pixel.y() - half.y());
        values_[k] = 0.5F * (up + down);
        slopes_[k] = up - down;
      }
    }
    length_ = normalize(&values_);
    return true;
  }

  float likeness(const Values& wanted) const {
    return length_ > kLeastContrast * kSide ? dot(values_, wanted) : 0.0F;
  }

  /// Adds to the normal equation of the change of the inverse depth.
  void linearize(const Values& wanted, double* squares, double* right) {
    Values slopes = slopes_;
    const float slope_length = normalize(&slopes);
    const float along = dot(slopes, values_);  // a change of contrast explains this part
    float squared = 0.0F;
    float product = 0.0F;
    for (int k = 0; k < kArea; ++k) {
      const float slope = slopes[k] - along * values_[k];
      squared += slope * slope;
      product += slope * (wanted[k] - values_[k]);
    }
    const double scale = rate_.norm() * slope_length / length_;
    *squares += scale * scale * squared;
    *right += scale * product;
  }

  double rate() const { return rate_.norm(); }

 private:
  const cv::Mat& gray_;
  PinholeCamera camera_;
  Eigen::Vector3d ray_;
  Eigen::Vector3d shift_;
  Eigen::Vector3d per_x_;
  Eigen::Vector3d per_y_;
  Eigen::Vector2d rate_ = Eigen::Vector2d::Zero();
  Values values_{};
  Values slopes_{};
  float length_ = 0.0F;
};

bool sample_reference(const cv::Mat& gray, const Eigen::Vector2d& pixel, Values* values) {
  const int x0 = static_cast<int>(pixel.x());
  const int y0 = static_cast<int>(pixel.y());
  if (x0 < kRadius || y0 < kRadius || x0 + kRadius >= gray.cols || y0 + kRadius >= gray.rows) {
    return false;
  }
  int k = 0;
  for (int y = -kRadius; y <= kRadius; ++y) {
    for (int x = -kRadius; x <= kRadius; ++x) {
      (*values)[k++] = gray.at<std::uint8_t>(y0 + y, x0 + x);
    }
  }
  return true;
}

/// Iterates on the images that see the patch.
class Refinement {
 public:
  Refinement(const Values& wanted, std::vector<OtherImage> images, double inverse_depth)
      : wanted_(wanted), images_(std::move(images)), start_(inverse_depth), now_(inverse_depth) {}

  /// Drops the images that do not show the patch; false if too few are left.
  bool choose(bool is_flat) {
    std::vector<OtherImage> having;
    for (OtherImage& image : images_) {
      if (image.sample(start_)) {
        having.push_back(image);
      }
    }
    having_ = having.size();
    images_ = std::move(having);
    return is_flat ? !images_.empty() : drop_unlike();
  }

  /// Drops the images that look less like the reference than the best one does; false if fewer than
  /// half are left.
  bool drop_unlike() {
    float best = kUnlike;
    for (const OtherImage& image : images_) {
      best = std::max(best, image.likeness(wanted_) - kLessLike);
    }
    std::vector<OtherImage> like;
    std::copy_if(
        images_.begin(), images_.end(), std::back_inserter(like), [&](const OtherImage& image) {
          return image.likeness(wanted_) >= best;
        });
    images_ = std::move(like);
    return !images_.empty() && 2 * images_.size() >= having_;
  }

  void iterate() {
    for (int k = 0; k < kMostIterations; ++k) {
      double squares = 0.0;
      double right = 0.0;
      double rate = 0.0;
      for (OtherImage& image : images_) {
        image.linearize(wanted_, &squares, &right);
        rate = std::max(rate, image.rate());
      }
      const double next = now_ + right / squares;
      if (!(squares > 0.0) || !(std::abs(next - start_) * rate < kLargestChange) ||
          !sample_all(next)) {
        sample_all(now_ = start_);
        return;
      }
      const double step = (next - now_) * rate;
      now_ = next;
      if (std::abs(step) < kSmallChange) {
        return;
      }
    }
  }

  RefinedDepth result() const {
    RefinedDepth refined{now_, 0.0, 0.0};
    double squares = 0.0;
    for (const OtherImage& image : images_) {
      refined.likeness += image.likeness(wanted_);
      squares += image.rate() * image.rate();
    }
    const auto count = static_cast<double>(images_.size());
    refined.likeness /= count;
    refined.precision = std::sqrt(squares * std::min(1.0, 2.0 / count));
    return refined;
  }

  /// Nothing can be compared; the depth is only as good as the sweep's.
  RefinedDepth unrefined() const {
    RefinedDepth unrefined = result();
    unrefined.likeness = 1.0;
    unrefined.precision *= kFlatPrecision;
    return unrefined;
  }

 private:
  bool sample_all(double inverse_depth) {
    return std::all_of(images_.begin(), images_.end(), [&](OtherImage& image) {
      return image.sample(inverse_depth);
    });
  }

  const Values& wanted_;
  std::vector<OtherImage> images_;
  double start_;
  double now_;
  std::size_t having_ = 0;
};

}  // namespace

RefinedDepth refine_depth(const SweepImage& reference,
                          const std::vector<const SweepImage*>& others,
                          const SurfacePatch& patch) {
  Values wanted;
  if (!sample_reference(reference.gray, patch.pixel, &wanted)) {
    return {};
  }
  const float contrast = normalize(&wanted) / kSide;
  if (contrast < kNoContrast) {
    return {};
  }
  const bool is_flat = contrast < kLeastContrast;
  std::vector<OtherImage> images;
  images.reserve(others.size());
  for (const SweepImage* other : others) {
    images.emplace_back(reference, *other, patch);
  }
  Refinement refinement(wanted, std::move(images), patch.inverse_depth);
  if (!refinement.choose(is_flat)) {
    return {};
  }
  if (is_flat) {
    return refinement.unrefined();
  }
  refinement.iterate();
  // Now that the depth is better, an image in which the patch is half hidden stands out.
  if (!refinement.drop_unlike()) {
    return {};
  }
  refinement.iterate();
  return refinement.result();
}

Eigen::Vector2d measure_slant(const cv::Mat& inverse_depth, const cv::Point& at, double tolerance) {
  const double middle = inverse_depth.at<float>(at);
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int y = std::max(0, at.y - kSlantRadius);
       y <= std::min(inverse_depth.rows - 1, at.y + kSlantRadius);
       ++y) {
    for (int x = std::max(0, at.x - kSlantRadius);
         x <= std::min(inverse_depth.cols - 1, at.x + kSlantRadius);
         ++x) {
      const Eigen::Vector2d place(x - at.x, y - at.y);
      const double difference = inverse_depth.at<float>(y, x) - middle;
      if (std::abs(difference) < tolerance) {
        matrix += place * place.transpose();
        right += difference * place;
      }
    }
  }
  const double trace = matrix.trace();
  if (!(matrix.determinant() > 1e-3 * trace * trace)) {
    return Eigen::Vector2d::Zero();  // pixels on a line say nothing across it
  }
  return matrix.inverse() * right;
}

}  // namespace facet_mapping::detail
