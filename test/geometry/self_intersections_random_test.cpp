// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of crossing facets of random meshes, against those that CGAL finds in its own mesh.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "support/meshes.h"
#ifdef __clang_analyzer__
#define CGAL_DO_NOT_USE_MPZF  // the analyser takes how it keeps its digits for an error
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include "facet_mapping/geometry/self_intersections.h"

namespace facet_mapping {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

std::vector<FacetPair> pairs_of_cgal(const TriangleMesh& mesh) {
  Surface surface;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    surface.add_vertex({v.x(), v.y(), v.z()});
  }
  for (const Triangle& t : mesh.triangles) {
    const auto face = surface.add_face(
        Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2]));
    EXPECT_TRUE(face.is_valid());
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(
      surface, std::back_inserter(found));
  std::vector<FacetPair> pairs;
  for (const auto& [f, g] : found) {
    pairs.emplace_back(std::minmax<std::uint32_t>(f, g));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// A closed or an open surface with noise, strong enough that it runs through itself. With
/// `rounded` coordinates corners touch facets and edges, and facets lie in one plane.
TriangleMesh rough_surface(int seed, bool closed, bool rounded) {
  TriangleMesh mesh = closed ? test::make_sphere(1.0, 3) : test::make_grid_plane(18, 18, 0.1);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.09);
  for (Eigen::Vector3d& v : mesh.vertices) {
    v +=
        Eigen::Vector3d(noise(random), noise(random), closed ? noise(random) : 0.2 * noise(random));
    if (rounded) {
      v = (32.0 * v).array().round() / 32.0;
    }
  }
  std::vector<bool> has_area;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    has_area.push_back(!facet_cross(mesh, f).isZero(0.0));
  }
  return select_facets(mesh, has_area);
}

class RoughSurface : public testing::TestWithParam<std::tuple<int, bool, bool>> {
 protected:
  RoughSurface() : mesh_(std::apply(rough_surface, GetParam())) {}

  TriangleMesh mesh_;
};

TEST_P(RoughSurface, HasThePairsThatCgalFinds) {
  const std::vector<FacetPair> pairs = find_self_intersections(mesh_);
  EXPECT_GT(pairs.size(), 20U);
  EXPECT_EQ(pairs, pairs_of_cgal(mesh_));
  EXPECT_EQ(count_self_intersections(mesh_), pairs.size());
}

TEST_P(RoughSurface, ChangedFacetsHaveTheirShareOfThePairs) {
  const std::vector<FacetPair> all = find_self_intersections(mesh_);
  for (const int every : {2, 20, 200, 100000}) {
    std::vector<std::uint8_t> changed(mesh_.triangles.size(), 0);
    for (std::size_t f = 1; f < changed.size(); f += every) {
      changed[f] = 1;
    }
    std::vector<FacetPair> expected;
    std::copy_if(all.begin(), all.end(), std::back_inserter(expected), [&](const FacetPair& pair) {
      return changed[pair.first] != 0 || changed[pair.second] != 0;
    });
    EXPECT_EQ(find_self_intersections(mesh_, changed), expected);
  }
}

TEST_P(RoughSurface, OfAnyPairsThoseThatCrossAreKept) {
  std::vector<FacetPair> some;
  for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
    for (std::uint32_t g = f + 1; g < std::min<std::size_t>(f + 9, mesh_.triangles.size()); ++g) {
      some.emplace_back(f, g);
    }
  }
  const std::vector<FacetPair> all = find_self_intersections(mesh_);
  std::vector<FacetPair> expected;
  std::set_intersection(
      all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(expected));
  EXPECT_GT(expected.size(), 5U);
  EXPECT_EQ(keep_crossing(mesh_, some), expected);
}

INSTANTIATE_TEST_SUITE_P(Seeds,
                         RoughSurface,
                         testing::Combine(testing::Values(1, 2, 3),
                                          testing::Bool(),
                                          testing::Bool()));

/// All but two facets share one cell of whatever orders them in space.
TEST(SelfIntersections, AreFoundBesideFacetsThatAreVeryFarAway) {
  const TriangleMesh near = rough_surface(1, true, false);
  TriangleMesh far;
  far.vertices = {{1e15, 0.0, 0.0}, {1e15, 1e14, 0.0}, {1e15, 0.0, 1e14}};
  far.triangles = {{0, 1, 2}};
  EXPECT_EQ(find_self_intersections(test::joined(near, far)), find_self_intersections(near));
}

TEST(SelfIntersections, RefusesChangesOfOtherFacets) {
  EXPECT_THROW(find_self_intersections(test::make_sphere(1.0, 1), {1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
