// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/refined_overlay.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "support/meshes.h"
#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"
#include "facet_mapping/mapping/vertex_ids.h"
#include "facet_mapping/refinement/subdivision.h"

namespace facet_mapping {
namespace {

constexpr Label kMapLabel = 7;
constexpr Label kRefinedLabel = 11;

TriangleMesh labelled(TriangleMesh mesh, Label label) {
  mesh.labels.assign(mesh.triangles.size(), label);
  mesh.confidence.assign(mesh.triangles.size(), 0.5F);
  mesh.views.assign(mesh.triangles.size(), 3);
  return mesh;
}

TriangleMesh ball() {
  return labelled(test::make_sphere(1.0, 3), kMapLabel);
}

/// As refine() leaves it: finer, moved by 2 per cent, with another class and start points.
TriangleMesh refined_ball(const TriangleMesh& map, double growth = 1.02) {
  TriangleMesh mesh = subdivide(map, std::vector<double>(map.triangles.size(), 4.0), 1.5);
  mesh.start_points = mesh.vertices;
  for (Eigen::Vector3d& v : mesh.vertices) {
    v *= growth;
  }
  return labelled(std::move(mesh), kRefinedLabel);
}

/// The map after new evidence around +z: one vertex lies elsewhere, in other numbering.
TriangleMesh changed_ball(TriangleMesh map) {
  const auto top = std::max_element(map.vertices.begin(),
                                    map.vertices.end(),
                                    [](const auto& a, const auto& b) { return a.z() < b.z(); });
  *top *= 1.1;
  std::reverse(map.vertices.begin(), map.vertices.end());
  const auto last = static_cast<std::uint32_t>(map.vertices.size() - 1);
  for (Triangle& t : map.triangles) {
    t = {last - t[1], last - t[2], last - t[0]};
  }
  return map;
}

MeshPart upper_half() {
  MeshPart part;
  part.box = Eigen::AlignedBox3d(Eigen::Vector3d(-9, -9, 0), Eigen::Vector3d(9, 9, 9));
  return part;
}

/// How much farther out a facet's corners lie than on the map.
double growth_of(const TriangleMesh& mesh, std::size_t facet) {
  double now = 0.0;
  double start = 0.0;
  for (const std::uint32_t v : mesh.triangles[facet]) {
    now += mesh.vertices[v].norm();
    start += mesh.start_points[v].norm();
  }
  return now / start;
}

double middle_z(const TriangleMesh& mesh, std::size_t facet) {
  const Triangle& t = mesh.triangles[facet];
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]).z() / 3.0;
}

TEST(RefinedOverlay, GivesTheRefinedMeshBackWhileTheMapIsTheSame) {
  const TriangleMesh map = ball();
  const TriangleMesh refined = refined_ball(map);
  RefinedOverlay overlay;
  overlay.add(map, refined, {});
  const TriangleMesh merged = overlay.merge(map);
  EXPECT_EQ(merged.vertices, refined.vertices);
  EXPECT_EQ(merged.triangles, refined.triangles);
  EXPECT_EQ(merged.labels, refined.labels);
}

TEST(RefinedOverlay, KeepsWhatWasRefinedWhereTheMapHasNotChanged) {
  const TriangleMesh map = ball();
  RefinedOverlay overlay;
  overlay.add(map, refined_ball(map), {});
  const TriangleMesh merged = overlay.merge(changed_ball(map));
  EXPECT_TRUE(check_manifold(merged).is_closed_manifold());
  std::size_t kept = 0;
  for (std::size_t f = 0; f < merged.triangles.size(); ++f) {
    if (merged.labels[f] == kRefinedLabel) {
      ++kept;
      EXPECT_NEAR(growth_of(merged, f), 1.02, 1e-9) << f;
    } else {
      EXPECT_GT(middle_z(merged, f), 0.8) << f;  // only around the vertex that is new
    }
  }
  const std::size_t new_facets = 6;
  EXPECT_GE(kept, 4 * (map.triangles.size() - new_facets));
}

TEST(RefinedOverlay, RefinedVerticesLieExactlyWhereRefinementPutThem) {
  const TriangleMesh map = ball();
  const TriangleMesh refined = refined_ball(map);
  RefinedOverlay overlay;
  overlay.add(map, refined, {});
  const TriangleMesh merged = overlay.merge(changed_ball(map));
  std::size_t same = 0;
  for (const Eigen::Vector3d& v : refined.vertices) {
    same += std::count(merged.vertices.begin(), merged.vertices.end(), v);
  }
  EXPECT_GE(same + 10, refined.vertices.size());
}

TEST(RefinedOverlay, NewMapFacetsStayWhereTheMapperSeesThem) {
  const TriangleMesh map = ball();
  RefinedOverlay overlay;
  overlay.add(map, refined_ball(map), {});
  const TriangleMesh changed = changed_ball(map);
  const TriangleMesh merged = overlay.merge(changed);
  const auto highest = [](const TriangleMesh& mesh) {
    double z = 0.0;
    for (const Eigen::Vector3d& v : mesh.vertices) {
      z = std::max(z, v.z());
    }
    return z;
  };
  EXPECT_EQ(highest(merged), highest(changed));
}

TEST(RefinedOverlay, ASecondPartLeavesTheFirst) {
  const TriangleMesh map = ball();
  RefinedOverlay overlay;
  overlay.add(map, refined_ball(map), {});
  // The second call starts from the map: its lower half is the map's.
  TriangleMesh second = map;
  second.start_points = second.vertices;
  for (Eigen::Vector3d& v : second.vertices) {
    v *= v.z() > 0.2 ? 1.05 : 1.0;
  }
  second.labels.assign(second.labels.size(), 13);
  overlay.add(map, second, upper_half());
  for (const TriangleMesh& state : {map, changed_ball(map)}) {
    const TriangleMesh merged = overlay.merge(state);
    EXPECT_TRUE(check_manifold(merged).is_closed_manifold());
    for (std::size_t f = 0; f < merged.triangles.size(); ++f) {
      const double z = middle_z(merged, f);
      if (z < -0.1) {
        EXPECT_EQ(merged.labels[f], kRefinedLabel);
        EXPECT_NEAR(growth_of(merged, f), 1.02, 1e-9);
      } else if (z > 0.4 && z < 0.8) {
        EXPECT_EQ(merged.labels[f], 13);
        EXPECT_NEAR(growth_of(merged, f), 1.05, 1e-9);
      }
    }
  }
}

TEST(RefinedOverlay, TheWholeReplacesWhatWasThere) {
  const TriangleMesh map = ball();
  RefinedOverlay overlay;
  overlay.add(map, refined_ball(map, 1.02), {});
  overlay.add(map, refined_ball(map, 0.97), {});
  const TriangleMesh merged = overlay.merge(map);
  EXPECT_NEAR(growth_of(merged, 0), 0.97, 1e-9);
}

TEST(RefinedOverlay, RefiningAMergeAgainCoversTheNewMap) {
  const TriangleMesh map = ball();
  const TriangleMesh changed = changed_ball(map);
  RefinedOverlay overlay;
  overlay.add(map, refined_ball(map), {});
  TriangleMesh again = overlay.merge(changed);  // as refine() goes on from start_points
  for (Eigen::Vector3d& v : again.vertices) {
    v *= 1.01;
  }
  again.labels.assign(again.labels.size(), 13);
  overlay.add(changed, again, {});
  const TriangleMesh merged = overlay.merge(changed);
  EXPECT_EQ(merged.vertices, again.vertices);
  EXPECT_EQ(std::count(merged.labels.begin(), merged.labels.end(), 13),
            static_cast<std::ptrdiff_t>(merged.labels.size()));
}

TEST(RefinedOverlay, RoundingOfTheMapDoesNotMatter) {
  const TriangleMesh map = ball();
  RefinedOverlay overlay;
  overlay.add(map, refined_ball(map), {});
  TriangleMesh rounded = map;
  for (Eigen::Vector3d& v : rounded.vertices) {
    v = v.cast<float>().cast<double>();
  }
  const TriangleMesh merged = overlay.merge(rounded);
  EXPECT_EQ(std::count(merged.labels.begin(), merged.labels.end(), kMapLabel), 0);
}

TEST(RefinedOverlay, AnotherMapStaysAsItIs) {
  RefinedOverlay overlay;
  const TriangleMesh map = ball();
  overlay.add(map, refined_ball(map), {});
  TriangleMesh other = labelled(test::make_sphere(0.7, 2), kMapLabel);
  const TriangleMesh merged = overlay.merge(other);
  EXPECT_EQ(merged.vertices, other.vertices);
  EXPECT_EQ(merged.triangles, other.triangles);
  EXPECT_EQ(merged.labels, other.labels);
}

TEST(RefinedOverlay, NothingRememberedNothingChanged) {
  RefinedOverlay overlay;
  EXPECT_TRUE(overlay.empty());
  EXPECT_EQ(overlay.merge(ball()).vertices, ball().vertices);
  overlay.add(ball(), refined_ball(ball()), {});
  EXPECT_FALSE(overlay.empty());
  EXPECT_GT(overlay.bytes(), 0U);
  EXPECT_TRUE(overlay.merge(TriangleMesh{}).empty());
  overlay.clear();
  EXPECT_TRUE(overlay.empty());
}

TEST(RefinedOverlay, RefusesAMeshWithoutStartPoints) {
  RefinedOverlay overlay;
  EXPECT_THROW(overlay.add(ball(), ball(), {}), std::invalid_argument);
}

TEST(VertexIds, StayWithThePlace) {
  VertexIds ids;
  const Eigen::Vector3d a(1, 2, 3);
  const Eigen::Vector3d b(4, 5, 6);
  const Eigen::Vector3d c(7, 8, 9);
  const auto first = ids.number({a, b});
  const auto second = ids.number({c, b, a});
  EXPECT_EQ(second[1], first[1]);
  EXPECT_EQ(second[2], first[0]);
  EXPECT_NE(second[0], first[0]);
  EXPECT_NE(second[0], first[1]);
}

TEST(VertexIds, VerticesInOnePlaceDiffer) {
  VertexIds ids;
  const Eigen::Vector3d a(1, 2, 3);
  for (int k = 0; k < 3; ++k) {
    const auto numbers = ids.number({a, a, a});
    EXPECT_EQ(std::set<std::uint32_t>(numbers.begin(), numbers.end()).size(), 3U);
  }
}

}  // namespace
}  // namespace facet_mapping
