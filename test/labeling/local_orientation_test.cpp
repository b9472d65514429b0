// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/local_orientation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "labeling/global_orientation.h"
#include "oriented_facets.h"
#include "support/meshes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

LabelingConfig local(int local_facets) {
  LabelingConfig config = test::with_prior(OrientationPrior::kLocal);
  config.local_facets = local_facets;
  return config;
}

/// A mesh, the class of each facet, and what the models need of them.
struct Scene {
  TriangleMesh mesh;
  std::vector<ClassIndex> labels;
  std::vector<Eigen::Vector3d> normals;
  FacetGraph graph;
  std::vector<ClassIndex> none;

  Scene(TriangleMesh own_mesh, std::vector<ClassIndex> own_labels)
      : mesh(std::move(own_mesh)),
        labels(std::move(own_labels)),
        graph(make_facet_graph(mesh, LabelingConfig())),
        none(labels.size(), kNoClass) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      normals.push_back(facet_cross(mesh, f));
    }
  }
  ClassFacets facets() const { return {normals, labels, none, 2, LabelingConfig()}; }
  LocalOrientation local_model(int local_facets) const {
    return {facets(), graph, local(local_facets)};
  }
  GlobalOrientation global_model() const { return {facets(), LabelingConfig()}; }
  double x(std::size_t facet) const { return mesh.vertices[mesh.triangles[facet][0]].x(); }
};

/// A road along x, level over 40 m, then climbing 40 degrees over 8 m; 8 m wide, the outermost
/// metre on each side belongs to class 1.
Scene climbing_road() {
  TriangleMesh mesh = test::make_height_field(96, 16, 0.5, [](double x, double y) {
    return std::max(0.0, x - 16.0) * std::tan(40.0 * test::kDegree) +
           0.03 * std::sin(5.0 * x) * std::sin(4.0 * y);
  });
  std::vector<ClassIndex> labels;
  for (const Triangle& t : mesh.triangles) {
    const double y =
        (mesh.vertices[t[0]].y() + mesh.vertices[t[1]].y() + mesh.vertices[t[2]].y()) / 3;
    labels.push_back(std::abs(y) < 3.0 ? 0 : 1);
  }
  return {std::move(mesh), std::move(labels)};
}

double mean_cost(const OrientationModel& model, const Scene& scene, double from_x, double to_x) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t f = 0; f < scene.normals.size(); ++f) {
    if (scene.labels[f] == 0 && scene.x(f) >= from_x && scene.x(f) < to_x) {
      sum += model.cost(f, scene.normals[f], 0);
      ++count;
    }
  }
  return sum / count;
}

TEST(LocalOrientation, FollowsARoadThatClimbsWhereTheGlobalFormDoesNot) {
  const Scene scene = climbing_road();
  const LocalOrientation model = scene.local_model(200);
  const GlobalOrientation global = scene.global_model();
  EXPECT_GT(mean_cost(global, scene, 19.0, 24.0), 1.5);
  EXPECT_LT(mean_cost(model, scene, 19.0, 24.0), 0.3);
  EXPECT_LT(mean_cost(model, scene, -20.0, 10.0), 0.3);
  // On the slope a level facet is now the odd one; on the level road it is not.
  for (std::size_t f = 0; f < scene.normals.size(); ++f) {
    if (scene.x(f) > 22.0) {
      ASSERT_GT(model.cost(f, Eigen::Vector3d::UnitZ(), 0), 1.5);
    } else if (scene.x(f) < 10.0) {
      ASSERT_LT(model.cost(f, Eigen::Vector3d::UnitZ(), 0), 0.3);
    }
  }
}

TEST(LocalOrientation, ANeighbourhoodOfTheWholeMeshIsTheGlobalForm) {
  const Scene scene = climbing_road();
  const LocalOrientation model = scene.local_model(1000000);
  const GlobalOrientation global = scene.global_model();
  for (std::size_t f = 0; f < scene.normals.size(); ++f) {
    for (const std::size_t k : {0, 1}) {
      ASSERT_NEAR(model.cost(f, scene.normals[f], k), global.cost(f, scene.normals[f], k), 1e-9);
    }
  }
}

TEST(LocalOrientation, FarFromAClassItsGlobalDirectionHolds) {
  Scene scene = climbing_road();
  for (std::size_t f = 0; f < scene.labels.size(); ++f) {
    scene.labels[f] = scene.x(f) > 16.0 ? 1 : 0;
  }
  const LocalOrientation model = scene.local_model(200);
  const GlobalOrientation global = scene.global_model();
  for (std::size_t f = 0; f < scene.labels.size(); ++f) {
    if (scene.x(f) < 0.0) {
      ASSERT_NEAR(model.cost(f, scene.normals[f], 1), global.cost(f, scene.normals[f], 1), 1e-9);
    }
  }
}

TEST(LocalOrientation, OwnFacetsPayOneHalfOnAverage) {
  Scene scene = climbing_road();
  std::mt19937 random(3);
  for (Eigen::Vector3d& normal : scene.normals) {
    normal = normal.norm() * test::near_direction(normal.normalized(), 25.0, &random);
  }
  test::OrientedFacets facets;
  facets.normals = scene.normals;
  facets.labels = scene.labels;
  LabelingConfig config;
  config.normal_floor = 1e-6;
  for (const int size : {30, 200, 3000}) {
    const double cost = test::own_cost(scene.local_model(size), facets, 0, config);
    EXPECT_LE(cost, 0.5 + 1e-9);
    EXPECT_GT(cost, 0.4);  // less, as the whole mesh adds to the deviations
  }
}

TEST(LocalOrientation, UnitsAndTurnsOfTheSceneDoNotMatter) {
  const Scene scene = climbing_road();
  TriangleMesh mesh = scene.mesh;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.5, 0.5, -0.7).normalized()).matrix();
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    vertex = 1000.0 * turn * vertex + Eigen::Vector3d(5, 6, 7);
  }
  const Scene changed(mesh, scene.labels);
  const LocalOrientation expected = scene.local_model(200);
  const LocalOrientation model = changed.local_model(200);
  for (std::size_t f = 0; f < scene.normals.size(); ++f) {
    ASSERT_NEAR(model.cost(f, changed.normals[f], 0), expected.cost(f, scene.normals[f], 0), 1e-6);
  }
}

TEST(FacetPatches, HoldEveryFacetOnceAndHangTogether) {
  const Scene scene = climbing_road();
  const FacetPatches patches = make_patches(scene.graph, 20);
  std::vector<int> seen(scene.labels.size(), 0);
  for (std::size_t p = 0; p < patches.facets.size(); ++p) {
    EXPECT_LE(patches.facets[p].size(), 20U);
    for (const std::uint32_t f : patches.facets[p]) {
      ++seen[f];
      EXPECT_EQ(patches.patch_of[f], p);
      const bool joined = std::any_of(
          scene.graph.edges_of[f].begin(), scene.graph.edges_of[f].end(), [&](std::int32_t edge) {
            return edge >= 0 && patches.patch_of[scene.graph.other(edge, f)] == p;
          });
      EXPECT_TRUE(joined || patches.facets[p].size() == 1);
    }
  }
  EXPECT_EQ(seen, std::vector<int>(scene.labels.size(), 1));
}

TEST(FacetPatches, TheFacetsAroundAreNearAndEnough) {
  const Scene scene = climbing_road();
  const FacetPatches patches = make_patches(scene.graph, 20);
  for (std::uint32_t p = 0; p < patches.facets.size(); ++p) {
    FacetList around = facets_around(patches, p, 200);
    EXPECT_GE(around.size(), 200U);
    EXPECT_LT(around.size(), 1000U);
    const double x = scene.x(patches.facets[p].front());
    for (const std::uint32_t f : around) {
      EXPECT_LT(std::abs(scene.x(f) - x), 16.0);
    }
    std::sort(around.begin(), around.end());
    EXPECT_EQ(std::unique(around.begin(), around.end()), around.end());
  }
}

TEST(FacetPatches, PartsThatDoNotHangTogetherStayApart) {
  const TriangleMesh plane = test::make_grid_plane(4, 4, 1.0);
  const Scene scene(test::joined(plane, plane), std::vector<ClassIndex>(64, 0));
  const FacetPatches patches = make_patches(scene.graph, 8);
  EXPECT_EQ(facets_around(patches, patches.patch_of[0], 1000).size(), 32U);
  EXPECT_EQ(facets_around(patches, patches.patch_of[63], 1000).size(), 32U);
}

}  // namespace
}  // namespace facet_mapping
