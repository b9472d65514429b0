// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_raycaster.h"

#include <cmath>

#include "geometry/facet_tree.h"

namespace facet_mapping {

struct StreetRaycaster::Impl {
  const TriangleMesh& mesh;
  FacetTree tree;

  /// Where the ray's line meets the plane of a facet.
  double plane_distance(std::int32_t facet,
                        const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& direction) const {
    const auto f = static_cast<std::size_t>(facet);
    const Eigen::Vector3d normal = facet_cross(mesh, f);
    const Eigen::Vector3d& corner = mesh.vertices[mesh.triangles[f][0]];
    return normal.dot(corner - origin) / normal.dot(direction);
  }
};

StreetRaycaster::StreetRaycaster(const Street& street) : impl_(new Impl{street.mesh, {}}) {
  fill_tree({&street.mesh.vertices, &street.mesh.triangles}, &impl_->tree);
}

StreetRaycaster::~StreetRaycaster() = default;

std::optional<RayHit> StreetRaycaster::cast(const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction) const {
  const TreeKernel::Ray_3 ray(to_cgal(origin),
                              TreeKernel::Vector_3(direction.x(), direction.y(), direction.z()));
  const auto facet = impl_->tree.first_intersected_primitive(ray);
  if (!facet) {
    return std::nullopt;
  }
  const auto index = static_cast<std::int32_t>(*facet);
  return RayHit{index, impl_->plane_distance(index, origin, direction)};
}

double StreetRaycaster::distance(const Eigen::Vector3d& point) const {
  return std::sqrt(impl_->tree.squared_distance(to_cgal(point)));
}

}  // namespace facet_mapping
