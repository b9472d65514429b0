// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/facet_search.h"

#include <stdexcept>

#include "geometry/facet_tree.h"
#include <Eigen/Geometry>

namespace facet_mapping {

Eigen::Vector3d barycentric_weights(const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c,
                                    const Eigen::Vector3d& point) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (!(squared > 0.0)) {
    return Eigen::Vector3d::UnitX();
  }
  const double second = normal.dot((point - a).cross(c - a)) / squared;
  const double third = normal.dot((b - a).cross(point - a)) / squared;
  return {1.0 - second - third, second, third};
}

struct FacetSearch::Impl {
  FacetSource source;
  FacetTree tree;
};

FacetSearch::FacetSearch(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<Triangle>& triangles)
    : impl_(new Impl{{&points, &triangles}, {}}) {
  fill_tree(impl_->source, &impl_->tree);
  impl_->tree.accelerate_distance_queries();
}

FacetSearch::~FacetSearch() = default;

NearestFacet FacetSearch::nearest(const Eigen::Vector3d& point) const {
  if (impl_->tree.empty()) {
    throw std::logic_error("facet search: there is no facet");
  }
  const auto [found, facet] = impl_->tree.closest_point_and_primitive(to_cgal(point));
  const Eigen::Vector3d on_facet(found.x(), found.y(), found.z());
  const FacetSource& source = impl_->source;
  return {facet,
          on_facet,
          barycentric_weights(
              source.corner(facet, 0), source.corner(facet, 1), source.corner(facet, 2), on_facet)};
}

}  // namespace facet_mapping
