// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's tree of boxes over the facets of a mesh that is kept elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

using TreeKernel = CGAL::Simple_cartesian<double>;

inline TreeKernel::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Corners and facets; both must outlive the tree.
struct FacetSource {
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const std::vector<Triangle>* triangles = nullptr;

  const Eigen::Vector3d& corner(std::uint32_t facet, int k) const {
    return (*points)[(*triangles)[facet][k]];
  }
};

/// Nothing but a facet's index is stored.
class FacetPrimitive {
 public:
  using Id = std::uint32_t;
  using Point = TreeKernel::Point_3;
  using Datum = TreeKernel::Triangle_3;
  using Shared_data = FacetSource;  // NOLINT(readability-identifier-naming): CGAL's name

  FacetPrimitive() = default;
  FacetPrimitive(std::vector<Id>::const_iterator id, const FacetSource& /*source*/) : id_(*id) {}

  static Shared_data construct_shared_data(const FacetSource& source) { return source; }
  Id id() const { return id_; }
  Datum datum(const Shared_data& source) const {
    return {to_cgal(source.corner(id_, 0)),
            to_cgal(source.corner(id_, 1)),
            to_cgal(source.corner(id_, 2))};
  }
  Point reference_point(const Shared_data& source) const { return to_cgal(source.corner(id_, 0)); }

 private:
  Id id_ = 0;
};

using FacetTree = CGAL::AABB_tree<CGAL::AABB_traits<TreeKernel, FacetPrimitive>>;

/// Puts all facets into the tree and builds it.
void fill_tree(const FacetSource& source, FacetTree* tree);

}  // namespace facet_mapping
