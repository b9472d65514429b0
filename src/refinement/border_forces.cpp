// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "border_forces.h"

#include <optional>

#include "facet_mapping/refinement/border_trace.h"

namespace facet_mapping {
namespace {

/// The forces of one view, collected pixel pair by pixel pair.
class ForceCollector {
 public:
  ForceCollector(const TriangleMesh& mesh,
                 const std::vector<FacetNeighbours>& neighbours,
                 const SemanticView& view,
                 const FacetImage& image,
                 const SemanticGate& gate)
      : view_(view),
        image_(image),
        gate_(gate),
        rendered_(label_image(image, mesh)),
        tracer_(mesh, neighbours, view.view),
        world_from_cam_(view.view.world_from_cam.linear()) {}

  void visit(const cv::Point& p, const cv::Point& q) {
    const Label a = rendered_.at<Label>(p);
    const Label b = rendered_.at<Label>(q);
    if (a == b) {
      return;
    }
    const std::optional<BorderPoint> border = find_border(p, q);
    if (!border) {
      return;
    }
    const cv::Point w = border->position < 0.5 ? p : q;
    const auto pixel = static_cast<std::uint32_t>(w.y * rendered_.cols + w.x);
    const Label seen = view_.segmentation.at<Label>(w);
    const double slope = gate_.cost(pixel, a, seen) - gate_.cost(pixel, b, seen);
    const double largest = gate_.weight(pixel, a) + gate_.weight(pixel, b);
    if (largest > 0.0) {
      add(*border, Eigen::Vector2d(q.x - p.x, q.y - p.y), slope, largest);
    }
  }

  std::vector<VertexForce> take() { return std::move(forces_); }

 private:
  std::optional<BorderPoint> trace(const cv::Point& from, const cv::Point& to) const {
    const int facet = image_.facets.at<int>(from);
    if (facet < 0) {
      return std::nullopt;
    }
    return tracer_.trace(facet,
                         {static_cast<double>(from.x), static_cast<double>(from.y)},
                         {static_cast<double>(to.x), static_cast<double>(to.y)});
  }

  /// The end of p's class or of q's, whichever is there; if both end the nearer one hides the
  /// other.
  std::optional<BorderPoint> find_border(const cv::Point& p, const cv::Point& q) const {
    const std::optional<BorderPoint> from_p = trace(p, q);
    std::optional<BorderPoint> from_q = trace(q, p);
    if (from_q) {
      from_q->position = 1.0 - from_q->position;
    }
    if (!from_p || !from_q) {
      return from_p ? from_p : from_q;
    }
    return from_p->point_in_cam.z() <= from_q->point_in_cam.z() ? from_p : from_q;
  }

  void add(const BorderPoint& border, const Eigen::Vector2d& m, double slope, double largest) {
    const Eigen::Vector3d lever =
        world_from_cam_ *
        (view_.view.camera.projection_jacobian(border.point_in_cam).transpose() * m);
    for (int end = 0; end < 2; ++end) {
      forces_.push_back({border.vertices[end],
                         border.weights[end] * slope * lever,
                         border.weights[end] * largest * lever.squaredNorm(),
                         border.occluding});
    }
  }

  const SemanticView& view_;
  const FacetImage& image_;
  const SemanticGate& gate_;
  cv::Mat rendered_;
  BorderTracer tracer_;
  Eigen::Matrix3d world_from_cam_;
  std::vector<VertexForce> forces_;
};

}  // namespace

std::vector<VertexForce> border_forces(const TriangleMesh& mesh,
                                       const std::vector<FacetNeighbours>& neighbours,
                                       const SemanticView& view,
                                       const FacetImage& image,
                                       const SemanticGate& gate) {
  ForceCollector collector(mesh, neighbours, view, image, gate);
  for (int y = 0; y < image.facets.rows; ++y) {
    for (int x = 0; x < image.facets.cols; ++x) {
      if (x + 1 < image.facets.cols) {
        collector.visit({x, y}, {x + 1, y});
      }
      if (y + 1 < image.facets.rows) {
        collector.visit({x, y}, {x, y + 1});
      }
    }
  }
  return collector.take();
}

}  // namespace facet_mapping
