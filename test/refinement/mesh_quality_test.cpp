// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/mesh_quality.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "ill_shaped.h"
#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"
#include "facet_mapping/geometry/self_intersections.h"

namespace facet_mapping {
namespace {

struct Case {
  std::string name;
  TriangleMesh mesh;
};

TriangleMesh waves() {
  return test::make_height_field(
      16, 13, 0.1, [](double x, double y) { return 0.05 * std::sin(5.0 * x) * std::cos(4.0 * y); });
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> list;
    for (int seed = 1; seed <= 4; ++seed) {
      const std::string name = " " + std::to_string(seed);
      list.push_back({"sphere" + name, test::ill_shaped(test::make_sphere(1.0, 3), seed)});
      list.push_back({"torus" + name, test::ill_shaped(test::make_torus(1.0, 0.4, 24, 12), seed)});
      list.push_back({"box" + name, test::ill_shaped(test::make_box({1.0, 0.7, 0.5}, 2), seed)});
      list.push_back({"waves" + name, test::ill_shaped(waves(), seed)});
    }
    return list;
  }();
  return all;
}

class MeshQuality : public testing::TestWithParam<std::size_t> {
 protected:
  const TriangleMesh& before_ = cases()[GetParam()].mesh;
  QualityReport report_;
  TriangleMesh after_ = improve_quality(before_, {}, &report_);
  double bound_ = QualityOptions().max_drift * test::longest_local_length(before_);
};

TEST_P(MeshQuality, KeepsTheTopology) {
  const ManifoldReport before = check_manifold(before_);
  const ManifoldReport after = check_manifold(after_);
  EXPECT_EQ(after.to_string(), before.to_string());
  EXPECT_EQ(test::euler_characteristic(after_), test::euler_characteristic(before_));
  EXPECT_EQ(before_.vertices.size() - after_.vertices.size(), report_.collapses);
  EXPECT_EQ(before_.triangles.size() - after_.triangles.size(), 2 * report_.collapses);
}

TEST_P(MeshQuality, MakesAnglesLarger) {
  const std::vector<double> before = test::sorted_angles_deg(before_);
  const std::vector<double> after = test::sorted_angles_deg(after_);
  EXPECT_GT(report_.collapses, 0U);
  EXPECT_GT(report_.flips, 0U);
  EXPECT_GE(after.front(), before.front());
  EXPECT_LT(test::count_below(after, 8.0), 0.5 * test::count_below(before, 8.0));
  for (const double limit : {2.0, 5.0, 10.0, 15.0, 20.0, 25.0}) {
    EXPECT_LE(test::count_below(after, limit), test::count_below(before, limit)) << limit;
  }
}

TEST_P(MeshQuality, TheSurfaceStaysWhereItIs) {
  EXPECT_LE(test::one_way_distance(after_, before_), bound_);
  EXPECT_LE(test::one_way_distance(before_, after_), bound_);
}

TEST_P(MeshQuality, BordersStayWhereTheyAre) {
  const std::vector<test::Segment> before = test::border_segments(before_);
  const std::vector<test::Segment> after = test::border_segments(after_);
  ASSERT_FALSE(before.empty());
  EXPECT_LE(test::one_way_distance(after, before), bound_);
  EXPECT_LE(test::one_way_distance(before, after), bound_);
}

TEST_P(MeshQuality, CarriesTheAttributes) {
  validate(after_);
  ASSERT_EQ(after_.labels.size(), after_.triangles.size());
  ASSERT_EQ(after_.confidence.size(), after_.triangles.size());
  ASSERT_EQ(after_.views.size(), after_.triangles.size());
  for (std::size_t f = 0; f < after_.triangles.size(); ++f) {
    const Triangle& t = after_.triangles[f];
    const Eigen::Vector3d centre =
        (after_.vertices[t[0]] + after_.vertices[t[1]] + after_.vertices[t[2]]) / 3.0;
    const std::size_t old = test::nearest_facet(centre, before_).facet;
    EXPECT_EQ(after_.labels[f], before_.labels[old]);
    EXPECT_EQ(after_.confidence[f], before_.confidence[old]);
    EXPECT_EQ(after_.views[f], before_.views[old]);
  }
}

TEST_P(MeshQuality, DoesNotRunThroughItself) {
  ASSERT_EQ(count_self_intersections(before_), 0U);
  EXPECT_EQ(count_self_intersections(after_), 0U);
}

TEST_P(MeshQuality, EndsAndGivesTheSameAgain) {
  const TriangleMesh twin = improve_quality(before_);
  EXPECT_EQ(twin.vertices, after_.vertices);
  EXPECT_EQ(twin.triangles, after_.triangles);
  TriangleMesh mesh = after_;
  QualityReport last = report_;
  for (int k = 0; k < 10 && last.collapses + last.flips > 0; ++k) {
    mesh = improve_quality(mesh, {}, &last);
  }
  EXPECT_EQ(last.collapses + last.flips, 0U);
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         MeshQuality,
                         testing::Range<std::size_t>(0, 16),
                         [](const testing::TestParamInfo<std::size_t>& shape) {
                           std::string name = cases()[shape.param].name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(MeshQualityLimits, LeavesGoodMeshesAlone) {
  const TriangleMesh sphere = test::make_sphere(1.0, 3);
  const TriangleMesh same = improve_quality(sphere);
  EXPECT_EQ(same.vertices, sphere.vertices);
  EXPECT_EQ(same.triangles, sphere.triangles);
}

TEST(MeshQualityLimits, OpenBordersDoNotChange) {
  TriangleMesh mesh = test::ill_shaped(waves(), 9);
  mesh.labels.clear();
  mesh.confidence.clear();
  mesh.views.clear();
  TriangleMesh after = improve_quality(mesh);
  EXPECT_TRUE(after.labels.empty() && after.confidence.empty() && after.views.empty());
  mesh.labels.assign(mesh.triangles.size(), 0);
  after.labels.assign(after.triangles.size(), 0);
  EXPECT_EQ(test::border_segments(after), test::border_segments(mesh));
}

TEST(MeshQualityLimits, FacetsThatMayNotChangeStay) {
  const TriangleMesh mesh = test::ill_shaped(test::make_sphere(1.0, 3), 6);
  std::vector<std::uint8_t> may_change;
  for (const Triangle& t : mesh.triangles) {
    may_change.push_back(mesh.vertices[t[0]].z() > 0.0 ? 1 : 0);
  }
  const auto corners = [](const TriangleMesh& of, std::size_t f) {
    const Triangle& t = of.triangles[f];
    return std::array<Eigen::Vector3d, 3>{of.vertices[t[0]], of.vertices[t[1]], of.vertices[t[2]]};
  };
  QualityReport report;
  const TriangleMesh after = improve_quality(mesh, {}, &report, may_change);
  EXPECT_GT(report.collapses, 0U);
  EXPECT_GT(report.flips, 0U);
  std::size_t g = 0;  // survivors keep their order
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    while (may_change[f] == 0 && g < after.triangles.size() &&
           corners(after, g) != corners(mesh, f)) {
      ++g;
    }
    ASSERT_LT(g, after.triangles.size()) << "facet " << f << " is gone";
  }
  EXPECT_THROW(improve_quality(mesh, {}, nullptr, {1, 0}), std::invalid_argument);
}

TEST(MeshQualityLimits, ATetrahedronStaysOne) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0.001, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  ASSERT_TRUE(check_manifold(mesh).is_closed_manifold());
  EXPECT_EQ(improve_quality(mesh).triangles, mesh.triangles);
}

/// Without the link condition its short edges would collapse and leave a sheet.
TEST(MeshQualityLimits, DoesNotPinchAThinTube) {
  TriangleMesh mesh;
  constexpr std::uint32_t kRings = 5;
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    const double x = ring;
    mesh.vertices.insert(mesh.vertices.end(), {{x, 0, 0}, {x, 1, 0.01}, {x, 0, 0.02}});
    for (std::uint32_t k = 0; k < 3 && ring + 1 < kRings; ++k) {
      const std::uint32_t a = 3 * ring + k;
      const std::uint32_t b = 3 * ring + (k + 1) % 3;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 3, b}, {b, a + 3, b + 3}});
    }
  }
  const std::uint32_t last = 3 * (kRings - 1);
  mesh.triangles.insert(mesh.triangles.end(), {{0, 1, 2}, {last, last + 2, last + 1}});
  ASSERT_TRUE(check_manifold(mesh).is_closed_manifold()) << check_manifold(mesh).to_string();
  const TriangleMesh after = improve_quality(mesh);
  EXPECT_TRUE(check_manifold(after).is_closed_manifold()) << check_manifold(after).to_string();
  EXPECT_EQ(test::euler_characteristic(after), 2);
}

/// The flip that would help puts an edge where there is one already, on the lower side.
TEST(MeshQualityLimits, PutsNoEdgeTwice) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {2, 0.5, 0}, {2, -0.5, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {1, 3, 2}};
  ASSERT_TRUE(check_manifold(mesh).is_closed_manifold());
  EXPECT_EQ(improve_quality(mesh).triangles, mesh.triangles);
}

/// A needle that stands up from the surface is shape, not noise.
TEST(MeshQualityLimits, KeepsASpike) {
  TriangleMesh mesh = test::make_grid_plane(6, 6, 1.0);
  mesh.vertices[24].z() = 8.0;
  const TriangleMesh after = improve_quality(mesh);
  EXPECT_EQ(after.vertices, mesh.vertices);
}

TEST(MeshQualityLimits, TakesMeshesThatAreNoManifold) {
  TriangleMesh mesh = test::ill_shaped(test::make_sphere(1.0, 2), 3);
  mesh.labels.clear();
  mesh.confidence.clear();
  mesh.views.clear();
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({mesh.triangles[5][0], mesh.triangles[5][1], 60});
  mesh.vertices.emplace_back(5, 5, 5);
  const ManifoldReport before = check_manifold(mesh);
  const ManifoldReport after = check_manifold(improve_quality(mesh));
  EXPECT_LE(after.open_edges, before.open_edges);
  EXPECT_LE(after.non_manifold_edges, before.non_manifold_edges);
  EXPECT_EQ(after.degenerate_facets, before.degenerate_facets);
}

TEST(MeshQualityLimits, TakesAnEmptyMeshAndRefusesABrokenOne) {
  EXPECT_TRUE(improve_quality({}).empty());
  TriangleMesh mesh = test::make_grid_plane(2, 2, 1.0);
  mesh.labels = {1};
  EXPECT_THROW(improve_quality(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
