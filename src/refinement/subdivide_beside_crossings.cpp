// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "facet_mapping/refinement/crossings.h"
#include "facet_mapping/refinement/subdivision.h"

namespace facet_mapping {
namespace {

/// Facets that are not to be split, and how they spread.
class WholeFacets {
 public:
  WholeFacets(const TriangleMesh& mesh, const std::vector<FacetPair>& crossing)
      : mesh_(mesh), whole_(mesh.triangles.size(), 0) {
    for (const auto& [f, g] : crossing) {
      whole_[f] = whole_[g] = 1;
    }
  }

  void add_ring() {
    std::vector<std::uint8_t> touched(mesh_.vertices.size(), 0);
    for (std::size_t f = 0; f < whole_.size(); ++f) {
      for (const std::uint32_t v : mesh_.triangles[f]) {
        touched[v] |= whole_[f];
      }
    }
    for (std::size_t f = 0; f < whole_.size(); ++f) {
      for (const std::uint32_t v : mesh_.triangles[f]) {
        whole_[f] |= touched[v];
      }
    }
  }

  void clear_in(std::vector<double>* pixels) const {
    for (std::size_t f = 0; f < whole_.size(); ++f) {
      (*pixels)[f] *= whole_[f] != 0 ? 0.0 : 1.0;
    }
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::uint8_t> whole_;
};

}  // namespace

TriangleMesh subdivide_beside_crossings(const TriangleMesh& mesh,
                                        std::vector<double> pixels,
                                        double limit) {
  constexpr int kMaxRings = 4;
  const std::vector<FacetPair> crossing = find_self_intersections(mesh);
  if (crossing.empty()) {
    return subdivide(mesh, pixels, limit);
  }
  WholeFacets whole(mesh, crossing);
  for (int ring = 0;; ++ring) {
    whole.clear_in(&pixels);
    TriangleMesh finer = subdivide(mesh, pixels, limit);
    if (ring == kMaxRings || count_self_intersections(finer) <= crossing.size()) {
      return finer;
    }
    whole.add_ring();
  }
}

}  // namespace facet_mapping
