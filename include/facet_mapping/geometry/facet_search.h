// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facet nearest to a point.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// Barycentric weights, by areas, of where `point` falls on the plane of (a, b, c): sum 1, negative
/// outside. A facet without area is all its first corner.
Eigen::Vector3d barycentric_weights(const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c,
                                    const Eigen::Vector3d& point);

struct NearestFacet {
  std::uint32_t facet = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< of the facet
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< of its corners there, sum 1
};

class FacetSearch {
 public:
  /// Builds a tree of boxes over all facets; both arguments must outlive the search.
  FacetSearch(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles);
  ~FacetSearch();
  FacetSearch(const FacetSearch&) = delete;
  FacetSearch& operator=(const FacetSearch&) = delete;

  /// Distances do not depend on a facet's side. May be called from several threads. Throws
  /// std::logic_error if there is no facet.
  NearestFacet nearest(const Eigen::Vector3d& point) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace facet_mapping
