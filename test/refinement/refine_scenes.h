// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes whose true shape is known, for tests of the whole refinement.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "support/meshes.h"
#include "textured_scene.h"

#include "facet_mapping/refinement/refiner.h"

namespace facet_mapping::test {

struct Scene {
  TriangleMesh mesh;  ///< the start: the true shape with errors
  std::vector<LabeledView> views;
  /// Pixels that a point moves in the neighbouring view per metre along the normal.
  double parallax_px_per_m = 0.0;
};

constexpr double kArcStepDeg = 9.0;

inline std::vector<LabeledView> cast_views(const std::vector<View>& poses,
                                           const Surface& surface,
                                           double wavelength_m) {
  const Texture texture(wavelength_m, 11);
  std::vector<LabeledView> views;
  views.reserve(poses.size());
  for (const View& pose : poses) {
    views.push_back(cast_view(pose, surface, texture));
  }
  return views;
}

/// An open plane with waves of about one pixel of parallax and some noise.
inline Scene wavy_plane() {
  Scene scene;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.005);
  scene.mesh = make_height_field(30, 24, 0.07, [&](double x, double y) {
    return 0.05 * std::sin(4.0 * x + 0.3) * std::cos(3.0 * y - 0.2) + noise(random);
  });
  const PinholeCamera camera = make_camera(240, 180, 300.0);
  scene.views = cast_views(
      arc_of_views(camera, Eigen::Vector3d::Zero(), 3.0, kArcStepDeg, 3), plane_surface(), 0.15);
  scene.parallax_px_per_m = 300.0 / 3.0 * std::sin(kArcStepDeg * M_PI / 180.0);
  return scene;
}

constexpr double kBallRadius = 1.5;

/// Gives every view the class that `class_of` says of the point that a pixel shows; 0 for nothing.
template <typename ClassOf>
void segment(const Surface& surface, const ClassOf& class_of, std::vector<LabeledView>* views) {
  for (LabeledView& view : *views) {
    view.labels = cv::Mat(view.gray.size(), CV_16UC1, cv::Scalar(0));
    for (int y = 0; y < view.labels.rows; ++y) {
      for (int x = 0; x < view.labels.cols; ++x) {
        const Eigen::Vector3d direction =
            view.view.world_from_cam.linear() *
            view.view.camera.ray({static_cast<double>(x), static_cast<double>(y)});
        if (const auto hit = surface(view.view.center(), direction)) {
          view.labels.at<Label>(y, x) = class_of(*hit);
        }
      }
    }
  }
}

/// Root mean square of `error` (metres) over the vertices well inside all images, in pixels of
/// parallax.
template <typename Inside, typename Error>
double rms_px(const TriangleMesh& mesh, double px_per_m, const Inside& inside, const Error& error) {
  double sum = 0.0;
  int count = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    if (inside(v)) {
      sum += std::pow(error(v) * px_per_m, 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

inline double plane_error_px(const Scene& scene, const TriangleMesh& mesh) {
  return rms_px(
      mesh,
      scene.parallax_px_per_m,
      [](const Eigen::Vector3d& v) { return std::abs(v.x()) < 0.8 && std::abs(v.y()) < 0.6; },
      [](const Eigen::Vector3d& v) { return v.z(); });
}

inline double ball_error_px(const Scene& scene, const TriangleMesh& mesh) {
  return rms_px(
      mesh,
      scene.parallax_px_per_m,
      [](const Eigen::Vector3d& v) {
        return v.z() > 0.0 && std::abs(v.x()) < 0.7 && std::abs(v.y()) < 0.6;
      },
      [](const Eigen::Vector3d& v) { return v.norm() - kBallRadius; });
}

/// A closed ball with bumps of about one pixel of parallax, seen from one side.
inline Scene bumpy_ball(int subdivisions) {
  Scene scene;
  scene.mesh = make_sphere(kBallRadius, subdivisions);
  for (Eigen::Vector3d& v : scene.mesh.vertices) {
    v *= 1.0 + 0.025 * std::sin(4.0 * v.x() + 0.3) * std::cos(3.0 * v.y() - 0.2);
  }
  const PinholeCamera camera = make_camera(240, 180, 220.0);
  scene.views = cast_views(arc_of_views(camera, {0.0, 0.0, kBallRadius}, 2.5, kArcStepDeg, 3),
                           sphere_surface(kBallRadius),
                           0.15);
  scene.parallax_px_per_m = 220.0 / 2.5 * std::sin(kArcStepDeg * M_PI / 180.0);
  return scene;
}

/// A configuration for these small images: no segmentation, no relabelling.
inline RefinementConfig photometric_config() {
  RefinementConfig config;
  config.semantic = SemanticMode::kOff;
  config.relabel = false;
  config.levels = 2;
  config.iterations = 5;
  return config;
}

}  // namespace facet_mapping::test
