// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/smoothing_weights.h"

#include <tbb/parallel_for.h>

#include "facet_mapping/render/visibility.h"

namespace facet_mapping {
namespace {

/// Relative depth slack for facets smaller than a pixel.
constexpr double kDepthTolerance = 0.01;

void add_pixels(const TriangleMesh& mesh,
                const View& view,
                const FacetImage& image,
                double scale,
                std::vector<double>* weights) {
  for (int y = 0; y < image.facets.rows; ++y) {
    for (int x = 0; x < image.facets.cols; ++x) {
      const int facet = image.facets.at<int>(y, x);
      if (facet < 0) {
        continue;
      }
      const double pixels_per_metre = view.camera.fx / image.depth.at<float>(y, x);
      // Over a whole facet the barycentric weight of each corner is one third in the mean.
      const double share = scale * pixels_per_metre * pixels_per_metre / 3.0;
      for (const std::uint32_t v : mesh.triangles[facet]) {
        (*weights)[v] += share;
      }
    }
  }
}

/// Vertices without a pixel of their own that some view sees nevertheless.
std::vector<std::uint8_t> find_missed(const TriangleMesh& mesh,
                                      const std::vector<View>& views,
                                      const std::vector<SurfaceView>& surfaces,
                                      const std::vector<double>& weights) {
  std::vector<VisibilityTest> tests;
  for (std::size_t i = 0; i < views.size(); ++i) {
    tests.emplace_back(views[i], surfaces[i].image.depth, kDepthTolerance);
  }
  std::vector<std::uint8_t> missed(weights.size(), 0);
  tbb::parallel_for(std::size_t{0}, weights.size(), [&](std::size_t k) {
    for (std::size_t i = 0; i < tests.size() && weights[k] == 0.0 && missed[k] == 0; ++i) {
      missed[k] = tests[i].pixel(mesh.vertices[k]) ? 1 : 0;
    }
  });
  return missed;
}

}  // namespace

std::vector<double> smoothing_weights(const TriangleMesh& mesh,
                                      const std::vector<View>& views,
                                      const std::vector<SurfaceView>& surfaces,
                                      int partners_per_view) {
  const double scale = kPixelInformation * partners_per_view;
  std::vector<double> weights(mesh.vertices.size(), 0.0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    add_pixels(mesh, views[i], surfaces[i].image, scale, &weights);
  }
  const std::vector<std::uint8_t> missed = find_missed(mesh, views, surfaces, weights);
  const Adjacency neighbours = vertex_neighbours(mesh);
  std::vector<double> filled = weights;
  for (std::size_t k = 0; k < filled.size(); ++k) {
    if (missed[k] == 0) {
      continue;
    }
    double sum = 0.0;
    for (const std::uint32_t* l = neighbours.begin(k); l != neighbours.end(k); ++l) {
      sum += weights[*l];
    }
    filled[k] = neighbours.size(k) > 0 ? sum / static_cast<double>(neighbours.size(k)) : 0.0;
  }
  return filled;
}

}  // namespace facet_mapping
