// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/self_intersections.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "box_tree.h"
#include "facets_cross.h"

namespace facet_mapping {
namespace {

TreeBox box_of(const TriangleMesh& mesh, std::uint32_t facet, bool changed) {
  const Triangle& t = mesh.triangles[facet];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  const Eigen::Vector3d& b = mesh.vertices[t[1]];
  const Eigen::Vector3d& c = mesh.vertices[t[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), facet, changed};
}

/// What boxes cover along one axis, as ascending intervals that are apart.
class Coverage {
 public:
  void add(double low, double high) { intervals_.emplace_back(low, high); }

  void merge() {
    std::sort(intervals_.begin(), intervals_.end());
    std::vector<std::pair<double, double>> merged;
    for (const auto& [low, high] : intervals_) {
      if (merged.empty() || low > merged.back().second) {
        merged.emplace_back(low, high);
      }
      merged.back().second = std::max(merged.back().second, high);
    }
    intervals_ = std::move(merged);
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

/// Mostly few facets have changed: leaves those and what may be near one of them.
void remove_far(std::vector<TreeBox>* boxes) {
  std::array<Coverage, 3> covered;
  for (int axis = 0; axis < 3; ++axis) {
    for (const TreeBox& box : *boxes) {
      if (box.changed) {
        covered[axis].add(box.low[axis], box.high[axis]);
      }
    }
    covered[axis].merge();
  }
  const auto is_far = [&covered](const TreeBox& box) {
    return !(covered[0].meets(box.low[0], box.high[0]) &&
             covered[1].meets(box.low[1], box.high[1]) &&
             covered[2].meets(box.low[2], box.high[2]));
  };
  boxes->erase(std::remove_if(boxes->begin(), boxes->end(), is_far), boxes->end());
}

}  // namespace

std::vector<FacetPair> find_self_intersections(const TriangleMesh& mesh,
                                               const std::vector<std::uint8_t>& changed) {
  validate(mesh);
  if (!changed.empty() && changed.size() != mesh.triangles.size()) {
    throw std::invalid_argument("find_self_intersections: give `changed` per facet or not at all");
  }
  std::vector<TreeBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    boxes.push_back(box_of(mesh, f, changed.empty() || changed[f] != 0));
  }
  if (!changed.empty()) {
    remove_far(&boxes);
  }
  boxes.erase(std::remove_if(boxes.begin(),
                             boxes.end(),
                             [&](const TreeBox& box) { return is_degenerate(mesh, box.id); }),
              boxes.end());
  std::vector<FacetPair> pairs;
  BoxTree(boxes).visit_overlaps([&](std::uint32_t f, std::uint32_t g) {
    if (facets_cross(mesh, f, g)) {
      pairs.emplace_back(std::minmax(f, g));
    }
  });
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
