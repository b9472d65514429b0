// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/photometric_energy.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "pixel_forces.h"
#include "sum_over_pairs.h"
#include <tbb/parallel_for.h>

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

/// Whole numbers, so that the order of the sums does not matter.
struct Change {
  std::int64_t units = 0;
  std::int64_t pixels = 0;

  void add(const cv::Mat& from, const cv::Mat& to) {
    for (int y = 0; y < from.rows; ++y) {
      const auto* a = from.ptr<std::uint16_t>(y);
      const auto* b = to.ptr<std::uint16_t>(y);
      for (int x = 0; x < from.cols; ++x) {
        const bool both = a[x] != kNotCounted && b[x] != kNotCounted;
        units += both ? b[x] - a[x] : 0;
        pixels += both ? 1 : 0;
      }
    }
  }
};

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
  std::vector<std::vector<cv::Mat>> maps(views.size());
  const auto compare = [&](std::size_t i, std::size_t j, PixelForces* forces) {
    const WarpedImage warp =
        warp_image(mesh, normals, views[i].view, surfaces[i], views[j], surfaces[j]);
    const ZnccResult zncc = zncc_energy(
        views[i].reference, views[i].stats, warp.warped, warp.valid, config, with_gradient);
    add_pair(warp, zncc, forces);
    maps[i].push_back(zncc.map);  // one thread goes through the partners of a view
  };
  auto total = sum_over_pairs<PhotometricEnergy>(
      mesh, normals, views, surfaces, partners, with_gradient, compare);
  total.maps = std::move(maps);
  return total;
}

double mean_change(const PhotometricEnergy& from, const PhotometricEnergy& to) {
  if (from.maps.size() != to.maps.size()) {
    throw std::invalid_argument("photometric energy: shapes seen from different views");
  }
  std::vector<Change> changes(from.maps.size());
  tbb::parallel_for(std::size_t{0}, changes.size(), [&](std::size_t i) {
    if (from.maps[i].size() != to.maps[i].size()) {
      throw std::invalid_argument("photometric energy: view " + std::to_string(i) +
                                  " is compared with different partners");
    }
    for (std::size_t k = 0; k < from.maps[i].size(); ++k) {
      changes[i].add(from.maps[i][k], to.maps[i][k]);
    }
  });
  Change total;
  for (const Change& change : changes) {
    total.units += change.units;
    total.pixels += change.pixels;
  }
  return total.pixels == 0
             ? 0.0
             : static_cast<double>(total.units) / kEnergyUnits / static_cast<double>(total.pixels);
}

}  // namespace facet_mapping
