// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_raycaster.h"

#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

namespace facet_mapping {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

Point to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// A facet of a mesh that is kept elsewhere: nothing but its index is stored.
class FacetPrimitive {
 public:
  using Id = std::uint32_t;
  using Point = facet_mapping::Point;
  using Datum = Kernel::Triangle_3;
  using Shared_data = const TriangleMesh*;  // NOLINT(readability-identifier-naming): CGAL's name

  FacetPrimitive() = default;
  FacetPrimitive(std::vector<Id>::const_iterator id, const TriangleMesh* /*mesh*/) : id_(*id) {}

  static Shared_data construct_shared_data(const TriangleMesh* mesh) { return mesh; }
  Id id() const { return id_; }
  Datum datum(Shared_data mesh) const {
    const Triangle& t = mesh->triangles[id_];
    return {to_cgal(mesh->vertices[t[0]]),
            to_cgal(mesh->vertices[t[1]]),
            to_cgal(mesh->vertices[t[2]])};
  }
  Point reference_point(Shared_data mesh) const {
    return to_cgal(mesh->vertices[mesh->triangles[id_][0]]);
  }

 private:
  Id id_ = 0;
};

using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, FacetPrimitive>>;

}  // namespace

struct StreetRaycaster::Impl {
  const TriangleMesh& mesh;
  Tree tree;

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
  std::vector<std::uint32_t> facets(street.mesh.triangles.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    facets[f] = f;
  }
  impl_->tree.insert(facets.cbegin(), facets.cend(), &street.mesh);
  impl_->tree.build();
}

StreetRaycaster::~StreetRaycaster() = default;

std::optional<RayHit> StreetRaycaster::cast(const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction) const {
  const Kernel::Ray_3 ray(to_cgal(origin),
                          Kernel::Vector_3(direction.x(), direction.y(), direction.z()));
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
