// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/facet_pick.h"

#include <algorithm>
#include <utility>

namespace facet_mapping {
namespace {

bool is_drawn(const FacetVertex& last, const PickFilter& filter) {
  const auto& [slot, confidence, views, chunk] = last.facet;
  return slot < filter.shown.size() && filter.shown[slot] && confidence >= filter.min_confidence &&
         views >= filter.min_views;
}

/// Moeller and Trumbore 1997; infinity if the ray misses the facet.
double distance_to(const PickRay& ray, const std::array<Eigen::Vector3d, 3>& corners) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d ab = corners[1] - corners[0];
  const Eigen::Vector3d ac = corners[2] - corners[0];
  const Eigen::Vector3d p = ray.direction().cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0.0) {
    return kMiss;
  }
  const Eigen::Vector3d from_a = ray.origin() - corners[0];
  const Eigen::Vector3d q = from_a.cross(ab);
  const double u = from_a.dot(p) / determinant;
  const double v = ray.direction().dot(q) / determinant;
  const double distance = ac.dot(q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance >= 0.0 ? distance : kMiss;
}

}  // namespace

std::optional<double> entry_distance(const PickRay& ray, const Eigen::AlignedBox3d& box) {
  double near = 0.0;
  double far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double start = ray.origin()[axis];
    const double step = ray.direction()[axis];
    if (step == 0.0) {
      if (start < box.min()[axis] || start > box.max()[axis]) {
        return std::nullopt;
      }
      continue;
    }
    const auto [first, last] =
        std::minmax({(box.min()[axis] - start) / step, (box.max()[axis] - start) / step});
    near = std::max(near, first);
    far = std::min(far, last);
  }
  return near <= far ? std::optional(near) : std::nullopt;
}

std::optional<FacetHit> nearest_facet(const PickRay& ray,
                                      const PickFilter& filter,
                                      const Eigen::Vector3d& origin,
                                      const std::vector<FacetVertex>& vertices,
                                      const std::vector<std::uint32_t>& indices) {
  std::optional<FacetHit> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
    const FacetVertex& last = vertices[indices[k + 2]];
    if (!is_drawn(last, filter)) {
      continue;
    }
    FacetHit hit;
    for (std::size_t c = 0; c < 3; ++c) {
      hit.corners[c] =
          origin + Eigen::Vector3f::Map(vertices[indices[k + c]].position.data()).cast<double>();
    }
    hit.distance = distance_to(ray, hit.corners);
    if (hit.distance >= nearest ||
        (ray.pointAt(hit.distance) - filter.eye).norm() > filter.max_distance ||
        ray.pointAt(hit.distance).dot(filter.up) > filter.max_height ||
        (filter.cull_back_faces && hit.cross().dot(ray.direction()) > 0.0)) {
      continue;
    }
    nearest = hit.distance;
    hit.attributes = last.facet;
    best = std::move(hit);
  }
  return best;
}

}  // namespace facet_mapping
