// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of a smooth, textured surface by casting rays at the true surface: the refinement's ground
// truth, made without the rasteriser that the refinement itself uses.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "support/meshes.h"
#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/label.h"
#include "facet_mapping/labels/labeled_view.h"

namespace facet_mapping::test {

/// Smooth solid texture: plane waves with lengths around `wavelength_m`.
class Texture {
 public:
  Texture(double wavelength_m, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0.6, 1.7);
    for (int k = 0; k < 24; ++k) {
      const Eigen::Vector3d direction =
          Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
      waves_.push_back({2.0 * M_PI / (wavelength_m * uniform(random)) * direction,
                        2.0 * M_PI * uniform(random)});
    }
  }

  double operator()(const Eigen::Vector3d& point) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) {
      sum += std::sin(wave.frequency.dot(point) + wave.phase);
    }
    return 128.0 + 24.0 * sum;
  }

 private:
  struct Wave {
    Eigen::Vector3d frequency;
    double phase;
  };
  std::vector<Wave> waves_;
};

/// First hit of a ray (origin, direction) with the true surface.
using Surface =
    std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector3d&, const Eigen::Vector3d&)>;

inline Surface plane_surface() {
  return [](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    return std::optional<Eigen::Vector3d>(origin - origin.z() / direction.z() * direction);
  };
}

inline Surface sphere_surface(double radius) {
  return [radius](const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& direction) -> std::optional<Eigen::Vector3d> {
    const Eigen::Vector3d d = direction.normalized();
    const double half = origin.dot(d);
    const double root = half * half - origin.squaredNorm() + radius * radius;
    if (root < 0.0) {
      return std::nullopt;
    }
    return origin + (-half - std::sqrt(root)) * d;
  };
}

/// CV_32FC1; 128 where the ray meets nothing.
inline cv::Mat cast_image(const View& view, const Surface& surface, const Texture& texture) {
  cv::Mat image(view.camera.height, view.camera.width, CV_32FC1, cv::Scalar(128.0));
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const Eigen::Vector3d direction =
          view.world_from_cam.linear() *
          view.camera.ray({static_cast<double>(x), static_cast<double>(y)});
      if (const auto hit = surface(view.center(), direction)) {
        image.at<float>(y, x) = static_cast<float>(texture(*hit));
      }
    }
  }
  return image;
}

inline LabeledView cast_view(const View& view, const Surface& surface, const Texture& texture) {
  LabeledView result;
  result.view = view;
  cast_image(view, surface, texture).convertTo(result.gray, CV_8U);
  return result;
}

/// View from `eye` towards `target` with +y up in the image.
inline View view_with_y_up(const PinholeCamera& camera,
                           const Eigen::Vector3d& eye,
                           const Eigen::Vector3d& target) {
  const Eigen::Vector3d back = (eye - target).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(back).normalized();
  View view;
  view.camera = camera;
  view.world_from_cam.linear().col(0) = right;
  view.world_from_cam.linear().col(1) = right.cross(back);
  view.world_from_cam.linear().col(2) = -back;
  view.world_from_cam.translation() = eye;
  return view;
}

/// Cameras on an arc around the target, `step_deg` apart, at `distance` from it (along +z in the
/// middle of the arc), +y up in their images and +x to the right.
inline std::vector<View> arc_of_views(const PinholeCamera& camera,
                                      const Eigen::Vector3d& target,
                                      double distance,
                                      double step_deg,
                                      int count) {
  std::vector<View> views;
  for (int k = 0; k < count; ++k) {
    const double angle = (k - 0.5 * (count - 1)) * step_deg * M_PI / 180.0;
    const double tilt = (k % 2 == 0 ? 0.04 : -0.04);
    const Eigen::Vector3d back(std::sin(angle), std::sin(tilt), std::cos(angle));
    views.push_back(view_with_y_up(camera, target + distance * back, target));
  }
  return views;
}

}  // namespace facet_mapping::test
