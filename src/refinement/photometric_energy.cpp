// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/photometric_energy.h"

#include <memory>

#include "ordered_reduce.h"
#include "pixel_scatter.h"

#include "facet_mapping/refinement/visible_point.h"

namespace facet_mapping {
namespace {

/// One row's worth of constants for warping view i into view j.
struct Warp {
  const PinholeCamera& camera_i;
  const PinholeCamera& camera_j;
  Eigen::Isometry3d j_from_i;
  Eigen::Matrix3d i_from_world;
  Eigen::Vector3d center_i;

  Warp(const View& i, const View& j)
      : camera_i(i.camera),
        camera_j(j.camera),
        j_from_i(j.cam_from_world() * i.world_from_cam),
        i_from_world(i.world_from_cam.linear().transpose()),
        center_i(i.center()) {}
};

/// Sums over the partners of view i, per pixel of view i.
struct PixelForces {
  double energy = 0.0;
  std::size_t pixels = 0;
  cv::Mat force;      ///< CV_32FC1: d energy per metre along the normal
  cv::Mat curvature;  ///< CV_32FC1: its second-order bound
};

void add_pair(const WarpedImage& warp, const ZnccResult& zncc, PixelForces* forces) {
  forces->energy += zncc.energy;
  forces->pixels += zncc.pixels;
  if (zncc.derivative.empty()) {
    return;
  }
  const cv::Mat force = zncc.derivative.mul(warp.flow);
  const cv::Mat curvature = zncc.curvature.mul(warp.flow).mul(warp.flow);
  if (forces->force.empty()) {
    forces->force = force;
    forces->curvature = curvature;
  } else {
    forces->force += force;
    forces->curvature += curvature;
  }
}

}  // namespace

PhotometricView make_photometric_view(const View& view, const cv::Mat& gray, int window_px) {
  PhotometricView prepared;
  prepared.view = view;
  prepared.image = SplineImage(gray);
  prepared.reference = prepared.image.at_pixels();
  prepared.stats = window_stats(prepared.reference, window_px);
  return prepared;
}

WarpedImage warp_image(const TriangleMesh& mesh,
                       const std::vector<Eigen::Vector3d>& normals,
                       const View& view,
                       const SurfaceView& surface,
                       const PhotometricView& partner,
                       const SurfaceView& partner_surface) {
  const Warp warp(view, partner.view);
  const VisiblePoint visible(partner.view, partner_surface);
  WarpedImage result;
  result.warped = cv::Mat::zeros(surface.usable.size(), CV_32FC1);
  result.flow = cv::Mat::zeros(surface.usable.size(), CV_32FC1);
  result.valid = cv::Mat::zeros(surface.usable.size(), CV_8UC1);
  for (int y = 0; y < surface.usable.rows; ++y) {
    for (int x = 0; x < surface.usable.cols; ++x) {
      if (surface.usable.at<std::uint8_t>(y, x) == 0) {
        continue;
      }
      const int facet = surface.image.facets.at<int>(y, x);
      const Eigen::Vector3d& normal = normals[facet];
      // Distance of the facet's plane from the camera centre: n . d at every pixel of the facet.
      const double distance = normal.dot(mesh.vertices[mesh.triangles[facet][0]] - warp.center_i);
      const Eigen::Vector3d ray =
          warp.camera_i.ray({static_cast<double>(x), static_cast<double>(y)});
      const double depth = distance / (warp.i_from_world * normal).dot(ray);
      const Eigen::Vector3d d_in_j = warp.j_from_i.linear() * (depth * ray);
      const Eigen::Vector3d point_in_j = d_in_j + warp.j_from_i.translation();
      if (!visible.sees(point_in_j)) {
        continue;
      }
      const Eigen::Vector2d pixel = warp.camera_j.project(point_in_j);
      const ImageSample sample = partner.image.sample(pixel.x(), pixel.y());
      const Eigen::Vector2d motion =
          warp.camera_j.projection_jacobian(point_in_j) * d_in_j / distance;
      result.warped.at<float>(y, x) = sample.value;
      result.flow.at<float>(y, x) =
          static_cast<float>(sample.dx * motion.x() + sample.dy * motion.y());
      result.valid.at<std::uint8_t>(y, x) = 255;
    }
  }
  return result;
}

PhotometricEnergy photometric_energy(const TriangleMesh& mesh,
                                     const std::vector<PhotometricView>& views,
                                     const std::vector<SurfaceView>& surfaces,
                                     const std::vector<std::vector<int>>& partners,
                                     const ZnccConfig& config,
                                     bool with_gradient) {
  const std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  PhotometricEnergy total;
  if (with_gradient) {
    total.field = VertexField(mesh.vertices.size());
  }
  const auto compare_view = [&](std::size_t i) {
    PixelForces forces;
    for (const int j : partners[i]) {
      const WarpedImage warp =
          warp_image(mesh, normals, views[i].view, surfaces[i], views[j], surfaces[j]);
      add_pair(
          warp,
          zncc_energy(
              views[i].reference, views[i].stats, warp.warped, warp.valid, config, with_gradient),
          &forces);
    }
    return forces;
  };
  ordered_reduce(views.size(), compare_view, [&](std::size_t i, const PixelForces& forces) {
    total.sum += forces.energy;
    total.pixels += forces.pixels;
    if (!forces.force.empty()) {
      scatter_to_vertices(mesh,
                          normals,
                          views[i].view,
                          surfaces[i].image,
                          forces.force,
                          forces.curvature,
                          &total.field);
    }
  });
  return total;
}

}  // namespace facet_mapping
