// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/facet_search.h"

#include <random>
#include <stdexcept>

#include "support/meshes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

Eigen::Vector3d at(const TriangleMesh& mesh, const NearestFacet& nearest) {
  const Triangle& t = mesh.triangles[nearest.facet];
  return nearest.weights[0] * mesh.vertices[t[0]] + nearest.weights[1] * mesh.vertices[t[1]] +
         nearest.weights[2] * mesh.vertices[t[2]];
}

TEST(FacetSearch, FindsThePointOfTheMeshThatIsNearest) {
  const TriangleMesh mesh = test::make_sphere(1.0, 2);
  const FacetSearch search(mesh.vertices, mesh.triangles);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector3d point(uniform(random), uniform(random), uniform(random));
    const NearestFacet nearest = search.nearest(point);
    EXPECT_LT((at(mesh, nearest) - nearest.point).norm(), 1e-9);
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
      const Triangle& t = mesh.triangles[f];
      const Eigen::Vector3d middle =
          (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
      EXPECT_LE((nearest.point - point).norm(), (middle - point).norm() + 1e-12);
      EXPECT_LE((nearest.point - point).norm(), (mesh.vertices[t[0]] - point).norm() + 1e-12);
    }
  }
}

TEST(FacetSearch, NamesTheFacetThatAPointLiesOn) {
  const TriangleMesh mesh = test::make_grid_plane(5, 4, 0.5);
  const FacetSearch search(mesh.vertices, mesh.triangles);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const Eigen::Vector3d weights(0.5, 0.3, 0.2);
    const Eigen::Vector3d point =
        0.5 * mesh.vertices[t[0]] + 0.3 * mesh.vertices[t[1]] + 0.2 * mesh.vertices[t[2]];
    const NearestFacet nearest = search.nearest(point);
    EXPECT_EQ(nearest.facet, f);
    EXPECT_LT((nearest.weights - weights).norm(), 1e-9);
  }
}

TEST(FacetSearch, WeightsOutsideAreNegative) {
  const Eigen::Vector3d weights = barycentric_weights(
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1.0, 0.5, 3.0});  // the height does not count
  EXPECT_LT((weights - Eigen::Vector3d(1.5, -1.0, 0.5)).norm(), 1e-12);
}

TEST(FacetSearch, SaysThatThereIsNothing) {
  const FacetSearch search({}, {});
  EXPECT_THROW(search.nearest(Eigen::Vector3d::Zero()), std::logic_error);
}

}  // namespace
}  // namespace facet_mapping
