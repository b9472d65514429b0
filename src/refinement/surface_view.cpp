// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/surface_view.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <opencv2/imgproc.hpp>
#include <tbb/parallel_for.h>

#include "facet_mapping/render/observed_mesh.h"

namespace facet_mapping {
namespace {

/// 255 where the surface is seen at an incidence cosine of at least `min_cos`.
cv::Mat mark_well_seen(const TriangleMesh& mesh,
                       const std::vector<Eigen::Vector3d>& normals,
                       const View& view,
                       const FacetImage& image,
                       double min_cos) {
  cv::Mat mask = cv::Mat::zeros(image.facets.size(), CV_8UC1);
  const Eigen::Vector3d center = view.center();
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const int facet = image.facets.at<int>(y, x);
      if (facet < 0) {
        continue;
      }
      const Eigen::Vector3d& corner = mesh.vertices[mesh.triangles[facet][0]];
      const double distance = std::abs(normals[facet].dot(corner - center));
      const double range = image.depth.at<float>(y, x) *
                           view.camera.ray({static_cast<double>(x), static_cast<double>(y)}).norm();
      mask.at<std::uint8_t>(y, x) = distance >= min_cos * range ? 255 : 0;
    }
  }
  return mask;
}

bool is_jump(const PinholeCamera& camera, float a, float b, double min_cos) {
  const double nearer = std::min(a, b);
  return nearer <= 0.0 || std::abs(a - b) > largest_depth_step(camera, nearer, min_cos);
}

/// Clears both pixels beside each depth jump.
void clear_jumps(const PinholeCamera& camera, const cv::Mat& depth, double min_cos, cv::Mat* mask) {
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float here = depth.at<float>(y, x);
      if (x + 1 < depth.cols && is_jump(camera, here, depth.at<float>(y, x + 1), min_cos)) {
        mask->at<std::uint8_t>(y, x) = 0;
        mask->at<std::uint8_t>(y, x + 1) = 0;
      }
      if (y + 1 < depth.rows && is_jump(camera, here, depth.at<float>(y + 1, x), min_cos)) {
        mask->at<std::uint8_t>(y, x) = 0;
        mask->at<std::uint8_t>(y + 1, x) = 0;
      }
    }
  }
}

}  // namespace

double largest_depth_step(const PinholeCamera& camera, double z, double min_incidence_cos) {
  return z / (std::min(camera.fx, camera.fy) * min_incidence_cos);
}

SurfaceView make_surface_view(const TriangleMesh& mesh,
                              const std::vector<Eigen::Vector3d>& normals,
                              const View& view,
                              FacetImage image,
                              double min_incidence_cos) {
  SurfaceView surface;
  surface.usable = mark_well_seen(mesh, normals, view, image, min_incidence_cos);
  clear_jumps(view.camera, image.depth, min_incidence_cos, &surface.usable);
  constexpr int kSplineReach = 2;
  const cv::Mat kernel = cv::Mat::ones(2 * kSplineReach + 1, 2 * kSplineReach + 1, CV_8UC1);
  cv::erode(surface.usable, surface.sampled, kernel);
  surface.image = std::move(image);
  return surface;
}

std::vector<SurfaceView> render_surfaces(const TriangleMesh& mesh,
                                         const std::vector<View>& views,
                                         double min_incidence_cos) {
  const std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  const ObservedMesh observed(mesh);
  std::vector<SurfaceView> surfaces(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t k) {
    const std::unique_ptr<FacetRenderer> renderer = make_renderer();
    surfaces[k] = make_surface_view(
        mesh, normals, views[k], observed.render(renderer.get(), views[k]), min_incidence_cos);
  });
  return surfaces;
}

}  // namespace facet_mapping
