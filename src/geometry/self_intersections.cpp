// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/self_intersections.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "facets_cross.h"
#include <CGAL/box_intersection_d.h>

namespace facet_mapping {
namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

/// So many boxes are scanned rather than sorted into a tree: three times as fast on surfaces as
/// CGAL's own choice.
constexpr std::ptrdiff_t kScanBelow = 8000;

struct Bounds {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

Bounds bounds_of(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.triangles[facet];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  const Eigen::Vector3d& b = mesh.vertices[t[1]];
  const Eigen::Vector3d& c = mesh.vertices[t[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// What boxes cover along one axis, as ascending intervals that are apart.
class Coverage {
 public:
  Coverage(const std::vector<Box>& boxes, int axis) {
    for (const Box& box : boxes) {
      intervals_.emplace_back(box.min_coord(axis), box.max_coord(axis));
    }
    std::sort(intervals_.begin(), intervals_.end());
    std::size_t last = 0;
    for (std::size_t k = 1; k < intervals_.size(); ++k) {
      if (intervals_[k].first <= intervals_[last].second) {
        intervals_[last].second = std::max(intervals_[last].second, intervals_[k].second);
      } else {
        intervals_[++last] = intervals_[k];
      }
    }
    intervals_.resize(std::min(intervals_.size(), last + 1));
  }

  bool meets(double low, double high) const {
    const auto next = std::upper_bound(
        intervals_.begin(), intervals_.end(), high, [](double value, const auto& interval) {
          return value < interval.first;
        });
    return next != intervals_.begin() && std::prev(next)->second >= low;
  }

 private:
  std::vector<std::pair<double, double>> intervals_;
};

/// The boxes of the facets for which `wanted` is true.
template <typename Wanted>
std::vector<Box> make_boxes(const TriangleMesh& mesh, const Wanted& wanted) {
  std::vector<Box> boxes;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto [low, high] = bounds_of(mesh, f);
    if (wanted(f, low, high) && !is_degenerate(mesh, f)) {
      boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), f);
    }
  }
  return boxes;
}

}  // namespace

std::vector<FacetPair> find_self_intersections(const TriangleMesh& mesh,
                                               const std::vector<std::uint8_t>& changed) {
  validate(mesh);
  if (!changed.empty() && changed.size() != mesh.triangles.size()) {
    throw std::invalid_argument("find_self_intersections: give `changed` per facet or not at all");
  }
  using Point = Eigen::Vector3d;
  const auto is_changed = [&](std::uint32_t f) { return changed.empty() || changed[f] != 0; };
  std::vector<Box> changed_boxes =
      make_boxes(mesh, [&](std::uint32_t f, const Point&, const Point&) { return is_changed(f); });
  const std::array<Coverage, 3> covered = {
      Coverage(changed_boxes, 0), Coverage(changed_boxes, 1), Coverage(changed_boxes, 2)};
  std::vector<Box> other_boxes =
      make_boxes(mesh, [&](std::uint32_t f, const Point& low, const Point& high) {
        return !is_changed(f) && covered[0].meets(low[0], high[0]) &&
               covered[1].meets(low[1], high[1]) && covered[2].meets(low[2], high[2]);
      });
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
