// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/self_intersections.h"

#include <stdexcept>

#include "support/meshes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

/// Triangles in the plane z = 0 and upright through it.
TriangleMesh crossing_pair() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1.5, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

TEST(SelfIntersections, FindsTwoFacetsThatCross) {
  EXPECT_EQ(count_self_intersections(crossing_pair()), 1U);
}

TEST(SelfIntersections, SharedCornersAndEdgesAreNone) {
  EXPECT_EQ(count_self_intersections(test::make_sphere(1.0, 3)), 0U);
  EXPECT_EQ(count_self_intersections(test::make_grid_plane(5, 4, 0.3)), 0U);
}

TEST(SelfIntersections, FindsASpherePushedThroughItself) {
  TriangleMesh sphere = test::make_sphere(1.0, 3);
  sphere.vertices[0] = {-1.3, 0.02, 0.01};
  EXPECT_GT(count_self_intersections(sphere), 3U);
}

TEST(SelfIntersections, FindsAFacetFoldedOntoItsNeighbour) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.4, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(count_self_intersections(mesh), 1U);
}

TEST(SelfIntersections, TakesMeshesThatAreNoManifold) {
  TriangleMesh mesh = crossing_pair();
  mesh.vertices.emplace_back(2, 2, 3);
  mesh.vertices.emplace_back(2, -2, 3);
  mesh.triangles.push_back({1, 0, 6});
  mesh.triangles.push_back({0, 1, 7});  // a third facet at one edge
  mesh.triangles.push_back({0, 0, 1});  // no facet at all
  EXPECT_EQ(count_self_intersections(mesh), 1U);
}

TEST(SelfIntersections, NoFacetsNoIntersections) {
  EXPECT_EQ(count_self_intersections({}), 0U);
}

TEST(SelfIntersections, RefusesABrokenMesh) {
  TriangleMesh mesh = crossing_pair();
  mesh.triangles.push_back({0, 1, 99});
  EXPECT_THROW(count_self_intersections(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
