// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/seen_points.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "facet_mapping/geometry/median.h"
#include "facet_mapping/render/visibility.h"

namespace facet_mapping {

SeenPoints::SeenPoints(const TriangleMesh& mesh, const SeenPointsConfig& config)
    : mesh_(mesh), config_(config), renderer_(make_renderer()), seen_(mesh.vertices.size(), false) {
  if (mesh.empty()) {
    throw std::invalid_argument(
        "the mesh that the points come from has no facets: without a surface it cannot be found "
        "out which camera sees which point");
  }
  validate(mesh);
}

PointFrame SeenPoints::seen_from(const View& view, const cv::Mat& labels) {
  if (!labels.empty() && (labels.type() != CV_16UC1 || labels.cols != view.camera.width ||
                          labels.rows != view.camera.height)) {
    throw std::invalid_argument("seen points: the label image does not fit the camera");
  }
  const VisibilityTest test(view, renderer_->render(mesh_, view).depth, config_.depth_tolerance);
  const Eigen::Isometry3d cam_from_world = view.cam_from_world();
  PointFrame frame;
  frame.world_from_sensor = view.world_from_cam;
  for (std::size_t k = 0; k < mesh_.vertices.size(); ++k) {
    const std::optional<cv::Point> pixel = test.pixel(mesh_.vertices[k]);
    if (pixel) {
      seen_[k] = true;
      const Label label = labels.empty() ? kUnlabelled : labels.at<Label>(*pixel);
      frame.points.push_back({(cam_from_world * mesh_.vertices[k]).cast<float>(),
                              label,
                              static_cast<float>(config_.sigma_m)});
    }
  }
  return frame;
}

std::size_t SeenPoints::unseen() const {
  return static_cast<std::size_t>(std::count(seen_.begin(), seen_.end(), false));
}

double median_edge(const TriangleMesh& mesh) {
  std::vector<double> edges;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      edges.push_back((mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
    }
  }
  if (edges.empty()) {
    return 0.0;
  }
  return median(std::move(edges));
}

}  // namespace facet_mapping
