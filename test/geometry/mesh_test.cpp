// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/mesh.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  mesh.labels = {1, 2, 3, 4};
  return mesh;
}

TEST(TriangleMesh, NormalsPointOutOfATetrahedron) {
  const TriangleMesh mesh = tetrahedron();
  const std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  EXPECT_LT((normals[0] - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((normals[2] - Eigen::Vector3d(1, 1, 1).normalized()).norm(), 1e-12);
  EXPECT_LT(vertex_normals(mesh)[0].sum(), 0.0);
}

TEST(TriangleMesh, NeighboursShareAnEdge) {
  const TriangleMesh mesh = tetrahedron();
  const std::vector<FacetNeighbours> neighbours = facet_neighbours(mesh);
  EXPECT_EQ(neighbours[0], (FacetNeighbours{3, 2, 1}));
  EXPECT_EQ(vertex_facets(mesh).size(0), 3U);
  EXPECT_EQ(vertex_neighbours(mesh).size(0), 3U);
}

TEST(TriangleMesh, SelectionCarriesAttributes) {
  const TriangleMesh part = select_facets(tetrahedron(), {false, true, false, false});
  EXPECT_EQ(part.vertices.size(), 3U);
  ASSERT_EQ(part.triangles.size(), 1U);
  EXPECT_EQ(part.labels, std::vector<Label>{2});
  EXPECT_EQ(facet_neighbours(part)[0], (FacetNeighbours{-1, -1, -1}));
}

TEST(TriangleMesh, ValidationNamesWhatIsWrong) {
  TriangleMesh mesh = tetrahedron();
  EXPECT_NO_THROW(validate(mesh));
  mesh.labels.pop_back();
  EXPECT_THROW(validate(mesh), std::invalid_argument);
  mesh = tetrahedron();
  mesh.triangles[2][1] = 4;
  EXPECT_THROW(validate(mesh), std::invalid_argument);
  mesh = tetrahedron();
  mesh.vertices[1].y() = std::nan("");
  EXPECT_THROW(validate(mesh), std::invalid_argument);
}

TEST(TriangleMesh, BytesCountEveryAttributeAndSpareRoom) {
  TriangleMesh mesh;
  EXPECT_EQ(bytes_of(mesh), 0U);
  mesh.vertices.reserve(2);
  EXPECT_EQ(bytes_of(mesh), 2 * 24U);
  mesh.triangles.reserve(3);
  EXPECT_EQ(bytes_of(mesh), 2 * 24U + 3 * 12U);
  mesh.labels.reserve(4);
  EXPECT_EQ(bytes_of(mesh), 2 * 24U + 3 * 12U + 4 * 2U);
  mesh.confidence.reserve(5);
  EXPECT_EQ(bytes_of(mesh), 2 * 24U + 3 * 12U + 4 * 2U + 5 * 4U);
  mesh.views.reserve(6);
  EXPECT_EQ(bytes_of(mesh), 2 * 24U + 3 * 12U + 4 * 2U + 5 * 4U + 6 * 2U);
}

TEST(Manifold, TellsEachDefect) {
  EXPECT_TRUE(check_manifold(tetrahedron()).is_closed_manifold());
  TriangleMesh open = tetrahedron();
  open.triangles.pop_back();
  EXPECT_EQ(check_manifold(open).open_edges, 3U);
  TriangleMesh flipped = tetrahedron();
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  EXPECT_EQ(check_manifold(flipped).misoriented_edges, 3U);
  TriangleMesh doubled = tetrahedron();
  doubled.triangles.push_back(doubled.triangles[0]);
  EXPECT_EQ(check_manifold(doubled).non_manifold_edges, 3U);
  TriangleMesh degenerate = tetrahedron();
  degenerate.triangles.push_back({1, 1, 2});
  EXPECT_EQ(check_manifold(degenerate).degenerate_facets, 1U);
}

TEST(Manifold, TwoBodiesThatTouchInAVertexAreNotManifold) {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.insert(mesh.vertices.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  for (const Triangle& t : tetrahedron().triangles) {
    Triangle other = t;
    for (std::uint32_t& v : other) {
      v = v == 0 ? 0 : v + 3;
    }
    std::swap(other[0], other[1]);
    mesh.triangles.push_back(other);
  }
  const ManifoldReport report = check_manifold(mesh);
  EXPECT_EQ(report.non_manifold_vertices, 1U);
  EXPECT_EQ(report.open_edges + report.non_manifold_edges, 0U);
}

}  // namespace
}  // namespace facet_mapping
