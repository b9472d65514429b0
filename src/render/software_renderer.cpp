// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/software_renderer.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "render/render_input.h"
#include "render/triangle_filler.h"
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace facet_mapping {
namespace {

constexpr std::size_t kVertexGrain = 16384;

using Corners = std::array<const ScreenVertex*, 3>;

InverseDepth facet_depth(const PinholeCamera& camera, const Corners& v) {
  return inverse_depth(camera, v[0]->in_cam, v[1]->in_cam, v[2]->in_cam);
}

void fill_whole(TriangleFiller* filler,
                const Screen& screen,
                const Corners& v,
                std::int32_t facet) {
  const auto plane = [&] {
    InverseDepth depth = facet_depth(screen.camera(), v);
    depth.low = std::min({v[0]->inverse_z, v[1]->inverse_z, v[2]->inverse_z});
    depth.high = std::max({v[0]->inverse_z, v[1]->inverse_z, v[2]->inverse_z});
    return depth;
  };
  filler->fill(*v[0], *v[1], *v[2], plane, facet);
}

void fill_clipped(TriangleFiller* filler,
                  const Screen& screen,
                  const Corners& v,
                  std::int32_t facet) {
  const ClippedPolygon polygon = screen.clip(*v[0], *v[1], *v[2]);
  const auto plane = [&] {
    InverseDepth depth = facet_depth(screen.camera(), v);
    depth.low = polygon.corners[0].inverse_z;
    depth.high = depth.low;
    for (std::size_t k = 1; k < polygon.size; ++k) {
      depth.low = std::min(depth.low, polygon.corners[k].inverse_z);
      depth.high = std::max(depth.high, polygon.corners[k].inverse_z);
    }
    return depth;
  };
  for (std::size_t k = 2; k < polygon.size; ++k) {
    filler->fill(polygon.corners[0], polygon.corners[k - 1], polygon.corners[k], plane, facet);
  }
}

void draw(const std::vector<Triangle>& triangles,
          const std::vector<ScreenVertex>& vertices,
          const Screen& screen,
          const Band& band) {
  TriangleFiller filler(screen, band);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    const Corners v{&vertices[t[0]], &vertices[t[1]], &vertices[t[2]]};
    if ((v[0]->outside | v[1]->outside | v[2]->outside) == 0) {
      fill_whole(&filler, screen, v, static_cast<std::int32_t>(f));
    } else if ((v[0]->outside & v[1]->outside & v[2]->outside) == 0) {
      fill_clipped(&filler, screen, v, static_cast<std::int32_t>(f));
    }
  }
}

void invert(Band* band) {
  for (int y = band->begin; y < band->end; ++y) {
    auto* row = band->inverse_z.ptr<float>(y);
    for (int x = 0; x < band->inverse_z.cols; ++x) {
      row[x] = row[x] > 0.0F ? 1.0F / row[x] : 0.0F;
    }
  }
}

}  // namespace

void SoftwareRenderer::project_vertices(const TriangleMesh& mesh,
                                        const View& view,
                                        const Screen& screen) {
  const Eigen::Isometry3d cam_from_world = view.cam_from_world();
  vertices_.resize(mesh.vertices.size());
  const auto project = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      const Eigen::Vector3d in_cam = cam_from_world * mesh.vertices[v];
      if (!in_cam.allFinite()) {
        throw_vertex_not_finite(v);
      }
      vertices_[v] = screen.vertex(in_cam);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices_.size(), kVertexGrain), project);
}

FacetImage SoftwareRenderer::render(const TriangleMesh& mesh, const View& view) {
  check_render_input(mesh, view);
  const Screen screen(view.camera);
  project_vertices(mesh, view, screen);
  FacetImage image;
  image.facets.create(view.camera.height, view.camera.width, CV_32SC1);
  image.depth.create(view.camera.height, view.camera.width, CV_32FC1);
  const int bands = std::min(tbb::this_task_arena::max_concurrency(), view.camera.height);
  tbb::parallel_for(0, bands, [&](int k) {
    const int rows = view.camera.height;
    Band band{static_cast<int>(static_cast<std::int64_t>(rows) * k / bands),
              static_cast<int>(static_cast<std::int64_t>(rows) * (k + 1) / bands),
              image.facets,
              image.depth};
    band.facets.rowRange(band.begin, band.end).setTo(-1);
    band.inverse_z.rowRange(band.begin, band.end).setTo(0.0F);
    draw(mesh.triangles, vertices_, screen, band);
    invert(&band);
  });
  return image;
}

}  // namespace facet_mapping
