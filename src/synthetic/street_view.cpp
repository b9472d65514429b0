// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "noise.h"
#include "street_selection.h"
#include "street_shading.h"
#include "sun_shadows.h"
#include "surface_sampler.h"
#include "texture.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

constexpr float kMinCosine = 0.03F;  // of the viewing angle, bounds the footprint

void check(const StreetViewConfig& config) {
  if (config.supersampling < 1 || config.supersampling > 9 || config.supersampling % 2 == 0) {
    throw std::invalid_argument("street view: supersampling must be 1, 3, 5, 7 or 9");
  }
  if (!(config.view_distance_m > 1.0) || !(config.haze_m > 1.0)) {
    throw std::invalid_argument("street view: view_distance_m and haze_m must exceed 1 m");
  }
}

/// Colours the samples of one supersampled row.
class Painter {
 public:
  Painter(const Street& street, const SunShadows* shadows, const View& view, double haze_m)
      : sampler_(street),
        shadows_(shadows),
        view_(view),
        haze_(static_cast<float>(1.0 / haze_m)),
        to_sun_(street.to_sun.cast<float>()) {}

  /// `size`: sides of the square that the sample stands for, in samples.
  Eigen::Vector3f color(int x, int y, std::int32_t facet, float depth, float size) {
    const Eigen::Vector3d ray = view_.camera.ray({x, y});
    const Eigen::Vector3f direction =
        (view_.world_from_cam.linear() * ray).cast<float>().normalized();
    if (facet < 0) {
      return sky_color(direction);
    }
    const Eigen::Vector3d point = view_.world_from_cam * (ray * static_cast<double>(depth));
    const float distance = depth * static_cast<float>(ray.norm());
    const float clear = std::exp(-haze_ * distance);
    const Eigen::Vector3f haze(0.80F, 0.86F, 0.92F);
    return blend(haze, surface_color(facet, point, direction, size * depth), clear);
  }

 private:
  Eigen::Vector3f surface_color(std::int32_t facet,
                                const Eigen::Vector3d& point,
                                const Eigen::Vector3f& direction,
                                float sized_depth) {
    const SurfaceSample sample = sampler_.at(facet, point);
    const float facing = sampler_.facet_normal().dot(direction);
    const Eigen::Vector3f normal = facing > 0.0F ? Eigen::Vector3f(-sample.normal) : sample.normal;
    // Between the narrow and the long axis of the sample's ellipse on the surface.
    const float stretch = std::pow(std::max(std::abs(facing), kMinCosine), -0.6F);
    const float footprint = sized_depth / static_cast<float>(view_.camera.fx) * stretch;
    const float sun_cosine = std::max(0.0F, normal.dot(to_sun_));
    const float sunlit =
        shadows_ != nullptr && sun_cosine > 0.0F ? shadows_->sunlit(point, normal) : 1.0F;
    return reflectance(*sample.material, sample.texture, footprint)
        .cwiseProduct(irradiance(normal, sun_cosine, sunlit));
  }

  SurfaceSampler sampler_;
  const SunShadows* shadows_;
  View view_;
  float haze_;
  Eigen::Vector3f to_sun_;
};

/// Every `step`-th element of every `step`-th row, from the middle of the first step on.
template <typename T>
cv::Mat middle_samples(const cv::Mat& fine, int step) {
  cv::Mat coarse(fine.rows / step, fine.cols / step, fine.type());
  for (int y = 0; y < coarse.rows; ++y) {
    const T* row = fine.ptr<T>(y * step + step / 2);
    for (int x = 0; x < coarse.cols; ++x) {
      coarse.at<T>(y, x) = row[x * step + step / 2];
    }
  }
  return coarse;
}

cv::Mat class_image(const Street& street, const cv::Mat& facets) {
  cv::Mat labels(facets.size(), CV_8UC1);
  for (int y = 0; y < facets.rows; ++y) {
    for (int x = 0; x < facets.cols; ++x) {
      const auto facet = facets.at<std::int32_t>(y, x);
      const Label label =
          facet < 0 ? street_class::kSky : street.mesh.labels[static_cast<std::size_t>(facet)];
      labels.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(label);
    }
  }
  return labels;
}

}  // namespace

struct StreetRenderer::Impl {
  const Street& street;
  StreetViewConfig config;
  std::unique_ptr<SunShadows> shadows;

  FacetImage facets(const View& view) const {
    return render_parts(street, parts_in_view(street, view, config.view_distance_m), view);
  }

  /// Mean colour of each pixel's samples, CV_32FC3 (R G B).
  cv::Mat paint(const FacetImage& fine, const View& fine_view) const {
    const int n = config.supersampling;
    cv::Mat linear(fine.depth.rows / n, fine.depth.cols / n, CV_32FC3);
    tbb::parallel_for(0, linear.rows, [&](int y) {
      Painter painter(street, shadows.get(), fine_view, config.haze_m);
      for (int x = 0; x < linear.cols; ++x) {
        const Eigen::Vector3f color = pixel_color(fine, {n * x, n * y, n, n}, &painter);
        linear.at<cv::Vec3f>(y, x) = cv::Vec3f(color.x(), color.y(), color.z());
      }
    });
    return linear;
  }

  /// A pixel of one material takes every second sample, which halves the time of a picture.
  Eigen::Vector3f pixel_color(const FacetImage& fine,
                              const cv::Rect& pixel,
                              Painter* painter) const {
    const bool plain = pixel.width > 1 && one_material(fine.facets, pixel);
    const float footprint = plain ? std::sqrt(2.0F) : 1.0F;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    for (int y = pixel.y; y < pixel.br().y; ++y) {
      for (int x = pixel.x; x < pixel.br().x; ++x) {
        if (plain && (x - pixel.x + y - pixel.y) % 2 != 0) {
          continue;
        }
        sum += painter->color(
            x, y, fine.facets.at<std::int32_t>(y, x), fine.depth.at<float>(y, x), footprint);
        ++count;
      }
    }
    return sum / static_cast<float>(count);
  }

  bool one_material(const cv::Mat& facets, const cv::Rect& pixel) const {
    const auto material = [&](std::int32_t facet) {
      return facet < 0 ? -1 : static_cast<int>(street.material[static_cast<std::size_t>(facet)]);
    };
    const int first = material(facets.at<std::int32_t>(pixel.y, pixel.x));
    for (int y = pixel.y; y < pixel.br().y; ++y) {
      const auto* row = facets.ptr<std::int32_t>(y);
      for (int x = pixel.x; x < pixel.br().x; ++x) {
        if (material(row[x]) != first) {
          return false;
        }
      }
    }
    return true;
  }
};

StreetRenderer::StreetRenderer(const Street& street, const StreetViewConfig& config) {
  check(config);
  impl_.reset(new Impl{street, config, nullptr});
  if (config.shadows) {
    impl_->shadows = std::make_unique<SunShadows>(street);
  }
}

StreetRenderer::~StreetRenderer() = default;

StreetImage StreetRenderer::render(const View& view, const SensorNoise& noise) const {
  if (!view.camera.is_valid() || !is_rigid(view.world_from_cam)) {
    throw std::invalid_argument("street view: the camera or its pose is invalid");
  }
  const int n = impl_->config.supersampling;
  View fine_view = view;
  fine_view.camera = view.camera.resized(n * view.camera.width, n * view.camera.height);
  const FacetImage fine = impl_->facets(fine_view);
  StreetImage image;
  image.color = develop(impl_->paint(fine, fine_view), noise);
  image.depth = middle_samples<float>(fine.depth, n);
  image.labels = class_image(impl_->street, middle_samples<std::int32_t>(fine.facets, n));
  return image;
}

FacetImage StreetRenderer::render_facets(const View& view) const {
  return impl_->facets(view);
}

}  // namespace facet_mapping
