// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/border_trace.h"

#include <Eigen/Geometry>

namespace facet_mapping {

/// A facet as linear functions of the viewing ray: side[k] . ray has the sign of orientation inside
/// the side opposite to corner k and is proportional to the barycentric weight of corner k.
struct BorderTracer::Projected {
  std::array<Eigen::Vector3d, 3> corner;
  std::array<Eigen::Vector3d, 3> side;
  double orientation = 0.0;
};

BorderTracer::BorderTracer(const TriangleMesh& mesh,
                           const std::vector<FacetNeighbours>& neighbours,
                           const View& view)
    : mesh_(mesh),
      neighbours_(neighbours),
      camera_(view.camera),
      cam_from_world_(view.cam_from_world()) {}

BorderTracer::Projected BorderTracer::project(int facet) const {
  Projected result;
  for (int k = 0; k < 3; ++k) {
    result.corner[k] = cam_from_world_ * mesh_.vertices[mesh_.triangles[facet][k]];
  }
  for (int k = 0; k < 3; ++k) {
    result.side[k] = result.corner[(k + 1) % 3].cross(result.corner[(k + 2) % 3]);
  }
  result.orientation = result.corner[0].dot(result.side[0]) > 0.0 ? 1.0 : -1.0;
  return result;
}

namespace {

struct Exit {
  int side = -1;  ///< index of the edge (0-1, 1-2, 2-0)
  double position = 0.0;
};

/// Where the line from `start` along `delta` leaves the facet; `entered` is the edge it came by.
template <typename Facet>
Exit find_exit(const Facet& facet,
               const Eigen::Vector3d& start,
               const Eigen::Vector3d& delta,
               int entered) {
  Exit exit{-1, 1.0};
  for (int k = 0; k < 3; ++k) {
    const int edge = (k + 1) % 3;
    const double slope = facet.orientation * facet.side[k].dot(delta);
    if (edge == entered || slope >= 0.0) {
      continue;
    }
    const double position = -facet.orientation * facet.side[k].dot(start) / slope;
    if (position < exit.position) {
      exit = {edge, position};
    }
  }
  return exit;
}

}  // namespace

std::optional<BorderPoint> BorderTracer::trace(int facet,
                                               const Eigen::Vector2d& from,
                                               const Eigen::Vector2d& to) const {
  constexpr int kMaxFacets = 64;  // per pixel; far more never help
  const Eigen::Vector3d start = camera_.ray(from);
  const Eigen::Vector3d delta = camera_.ray(to) - start;
  const Label label = mesh_.labels[facet];
  Projected here = project(facet);
  int entered = -1;
  for (int k = 0; k < kMaxFacets; ++k) {
    const Exit exit = find_exit(here, start, delta, entered);
    if (exit.side < 0) {
      return std::nullopt;
    }
    const int next = neighbours_[facet][exit.side];
    if (next < 0) {
      return std::nullopt;
    }
    const Projected beyond = project(next);
    if (mesh_.labels[next] != label || beyond.orientation != here.orientation) {
      const int a = exit.side;
      const int b = (exit.side + 1) % 3;
      const Eigen::Vector3d ray = start + exit.position * delta;
      const double weight_a = here.side[a].dot(ray);
      const double weight_b = here.side[b].dot(ray);
      BorderPoint point;
      point.vertices = {mesh_.triangles[facet][a], mesh_.triangles[facet][b]};
      point.weights = {weight_a / (weight_a + weight_b), weight_b / (weight_a + weight_b)};
      point.point_in_cam = point.weights[0] * here.corner[a] + point.weights[1] * here.corner[b];
      point.position = exit.position;
      point.occluding = beyond.orientation != here.orientation;
      return point;
    }
    const FacetNeighbours& back = neighbours_[next];
    entered = back[0] == facet ? 0 : (back[1] == facet ? 1 : 2);
    facet = next;
    here = beyond;
  }
  return std::nullopt;
}

}  // namespace facet_mapping
