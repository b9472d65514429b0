// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <iterator>

#include "facet_mapping/refinement/crossings.h"
#include "facet_mapping/refinement/step.h"

namespace facet_mapping {
namespace {

/// 1 for each facet with a corner for which `vertex` is true.
template <typename VertexTest>
std::vector<std::uint8_t> facets_with(const TriangleMesh& mesh, const VertexTest& vertex) {
  std::vector<std::uint8_t> facets(mesh.triangles.size());
  std::transform(
      mesh.triangles.begin(), mesh.triangles.end(), facets.begin(), [&](const Triangle& t) {
        return vertex(t[0]) || vertex(t[1]) || vertex(t[2]) ? 1 : 0;
      });
  return facets;
}

/// Pairs of the changed facets that cross once `step` is made and did not before. `moved` has the
/// mesh's facets; its vertices are overwritten.
std::vector<FacetPair> new_crossings(const TriangleMesh& mesh,
                                     const std::vector<FacetPair>& known,
                                     const VectorField& step,
                                     const std::vector<std::uint8_t>& changed,
                                     TriangleMesh* moved) {
  std::transform(mesh.vertices.begin(),
                 mesh.vertices.end(),
                 step.begin(),
                 moved->vertices.begin(),
                 std::plus<>());
  const std::vector<FacetPair> now = find_self_intersections(*moved, changed);
  std::vector<FacetPair> added;
  std::set_difference(
      now.begin(), now.end(), known.begin(), known.end(), std::back_inserter(added));
  return added;
}

void shorten(const TriangleMesh& mesh,
             const std::vector<FacetPair>& pairs,
             double factor,
             VectorField* step) {
  std::vector<std::uint8_t> wanted(step->size(), 0);
  for (const auto& [f, g] : pairs) {
    for (const Triangle& t : {mesh.triangles[f], mesh.triangles[g]}) {
      wanted[t[0]] = wanted[t[1]] = wanted[t[2]] = 1;
    }
  }
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (wanted[k] != 0) {
      (*step)[k] *= factor;
    }
  }
}

}  // namespace

std::size_t prevent_crossings(const TriangleMesh& mesh,
                              const std::vector<FacetPair>& crossing,
                              VectorField* step) {
  constexpr int kHalvings = 1;  // more would seldom do
  const VectorField asked = *step;
  TriangleMesh moved;
  moved.triangles = mesh.triangles;
  moved.vertices.resize(mesh.vertices.size());
  prevent_flips(mesh, step);
  std::vector<std::uint8_t> changed =
      facets_with(mesh, [&](std::uint32_t v) { return !(*step)[v].isZero(0.0); });
  // Every round after the halvings stops further vertices for good, so the loop ends.
  for (int round = 0;; ++round) {
    const std::vector<FacetPair> added = new_crossings(mesh, crossing, *step, changed, &moved);
    if (added.empty()) {
      break;
    }
    const VectorField before = *step;
    shorten(mesh, added, round < kHalvings ? 0.5 : 0.0, step);
    prevent_flips(mesh, step);
    changed = facets_with(mesh, [&](std::uint32_t v) { return (*step)[v] != before[v]; });
  }
  std::size_t held = 0;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    held += (*step)[k] != asked[k] ? 1 : 0;
  }
  return held;
}

}  // namespace facet_mapping
