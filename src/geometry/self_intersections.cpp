// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/self_intersections.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "facets_cross.h"
#include <CGAL/box_intersection_d.h>

namespace facet_mapping {
namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

/// So many boxes are scanned rather than sorted into a tree: three times as fast on surfaces as
/// CGAL's own choice.
constexpr std::ptrdiff_t kScanBelow = 2000;

Box box_of(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.triangles[facet];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  const Eigen::Vector3d& b = mesh.vertices[t[1]];
  const Eigen::Vector3d& c = mesh.vertices[t[2]];
  const Eigen::Vector3d low = a.cwiseMin(b).cwiseMin(c);
  const Eigen::Vector3d high = a.cwiseMax(b).cwiseMax(c);
  return {CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), facet};
}

}  // namespace

std::vector<FacetPair> find_self_intersections(const TriangleMesh& mesh,
                                               const std::vector<std::uint8_t>& changed) {
  validate(mesh);
  if (!changed.empty() && changed.size() != mesh.triangles.size()) {
    throw std::invalid_argument("find_self_intersections: give `changed` per facet or not at all");
  }
  std::vector<Box> changed_boxes;
  std::vector<Box> other_boxes;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!is_degenerate(mesh, f)) {
      const bool is_changed = changed.empty() || changed[f] != 0;
      (is_changed ? changed_boxes : other_boxes).push_back(box_of(mesh, f));
    }
  }
  std::vector<FacetPair> pairs;
  const auto test = [&](const Box& a, const Box& b) {
    if (facets_cross(mesh, a.info(), b.info())) {
      pairs.emplace_back(std::minmax(a.info(), b.info()));
    }
  };
  const CGAL::Box_intersection_d::Box_traits_d<Box> traits;
  CGAL::box_self_intersection_d(
      changed_boxes.begin(), changed_boxes.end(), test, traits, kScanBelow);
  CGAL::box_intersection_d(changed_boxes.begin(),
                           changed_boxes.end(),
                           other_boxes.begin(),
                           other_boxes.end(),
                           test,
                           traits,
                           kScanBelow);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<FacetPair> keep_crossing(const TriangleMesh& mesh,
                                     const std::vector<FacetPair>& pairs) {
  std::vector<FacetPair> crossing;
  std::copy_if(
      pairs.begin(), pairs.end(), std::back_inserter(crossing), [&mesh](const FacetPair& pair) {
        return !is_degenerate(mesh, pair.first) && !is_degenerate(mesh, pair.second) &&
               facets_cross(mesh, pair.first, pair.second);
      });
  return crossing;
}

std::size_t count_self_intersections(const TriangleMesh& mesh) {
  return find_self_intersections(mesh).size();
}

}  // namespace facet_mapping
