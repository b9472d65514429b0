// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_filter.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace facet_mapping {
namespace {

Eigen::Vector3d to_eigen(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}

Eigen::Vector3d centroid(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
}

}  // namespace

bool is_everywhere(const BoxRegion& region) {
  return to_eigen(region.min).isZero(0.0) && to_eigen(region.max).isZero(0.0);
}

void validate(const BoxRegion& region) {
  const Eigen::Vector3d min = to_eigen(region.min);
  const Eigen::Vector3d max = to_eigen(region.max);
  if (!min.allFinite() || !max.allFinite() || (min.array() > max.array()).any()) {
    throw std::invalid_argument(
        "region: every coordinate of min must be finite and at most that of max (metres)");
  }
}

Eigen::AlignedBox3d box_in_map(const BoxRegion& region, const Eigen::Isometry3d& region_from_map) {
  const Eigen::AlignedBox3d box(to_eigen(region.min), to_eigen(region.max));
  const Eigen::Isometry3d map_from_region = region_from_map.inverse(Eigen::Isometry);
  Eigen::AlignedBox3d around;
  for (int corner = 0; corner < 8; ++corner) {
    around.extend(map_from_region *
                  box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  return around;
}

TriangleMesh filter_mesh(const TriangleMesh& mesh,
                         const BoxRegion& region,
                         const Eigen::Isometry3d& region_from_map,
                         const std::vector<Label>& classes) {
  const bool everywhere = is_everywhere(region);
  const Eigen::AlignedBox3d box(to_eigen(region.min), to_eigen(region.max));
  const std::set<Label> wanted(classes.begin(), classes.end());
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t f = 0; f < keep.size(); ++f) {
    const Label label = mesh.labels.empty() ? kUnlabelled : mesh.labels[f];
    keep[f] = (wanted.empty() || wanted.count(label) > 0) &&
              (everywhere || box.contains(region_from_map * centroid(mesh, mesh.triangles[f])));
  }
  return select_facets(mesh, keep);
}

}  // namespace facet_mapping
