// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/photometric_energy.h"

#include <optional>

#include "pixel_forces.h"
#include "sum_over_pairs.h"

#include "facet_mapping/refinement/surface_warp.h"

namespace facet_mapping {
namespace {

void add_pair(const WarpedImage& warp, const ZnccResult& zncc, PixelForces* forces) {
  forces->energy += zncc.energy;
  forces->pixels += zncc.pixels;
  if (!zncc.derivative.empty()) {
    forces->add(zncc.derivative.mul(warp.flow), zncc.curvature.mul(warp.flow).mul(warp.flow));
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
  const SurfaceWarp warp(mesh, normals, view, surface, partner.view, partner_surface);
  WarpedImage result;
  result.warped = cv::Mat::zeros(surface.usable.size(), CV_32FC1);
  result.flow = cv::Mat::zeros(surface.usable.size(), CV_32FC1);
  result.valid = cv::Mat::zeros(surface.usable.size(), CV_8UC1);
  for (int y = 0; y < surface.usable.rows; ++y) {
    for (int x = 0; x < surface.usable.cols; ++x) {
      const std::optional<WarpedPoint> point = warp.at(x, y);
      if (!point) {
        continue;
      }
      const ImageSample sample = partner.image.sample(point->pixel.x(), point->pixel.y());
      result.warped.at<float>(y, x) = sample.value;
      result.flow.at<float>(y, x) =
          static_cast<float>(sample.dx * point->motion.x() + sample.dy * point->motion.y());
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
  const auto compare = [&](std::size_t i, std::size_t j, PixelForces* forces) {
    const WarpedImage warp =
        warp_image(mesh, normals, views[i].view, surfaces[i], views[j], surfaces[j]);
    add_pair(
        warp,
        zncc_energy(
            views[i].reference, views[i].stats, warp.warped, warp.valid, config, with_gradient),
        forces);
  };
  return sum_over_pairs<PhotometricEnergy>(
      mesh, normals, views, surfaces, partners, with_gradient, compare);
}

}  // namespace facet_mapping
