// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street.h"

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "synthetic/test_street.h"
#include <gtest/gtest.h>

#include "facet_mapping/synthetic/street_raycaster.h"

namespace facet_mapping {
namespace {

using testing::short_street;

TEST(Street, EveryFacetHasALabelAreaAndMaterial) {
  const Street& street = short_street();
  EXPECT_NO_THROW(validate(street.mesh));
  ASSERT_EQ(street.mesh.labels.size(), street.mesh.triangles.size());
  ASSERT_EQ(street.material.size(), street.mesh.triangles.size());
  for (std::size_t f = 0; f < street.mesh.triangles.size(); ++f) {
    EXPECT_LT(street.material[f], street.materials.size());
    EXPECT_GT(facet_cross(street.mesh, f).norm(), 1e-9) << "facet " << f;
  }
}

TEST(Street, ShowsEveryClassAndNoOther) {
  const std::set<Label> labels(short_street().mesh.labels.begin(),
                               short_street().mesh.labels.end());
  const std::set<Label> expected{street_class::kRoad,
                                 street_class::kSidewalk,
                                 street_class::kBuilding,
                                 street_class::kPole,
                                 street_class::kTrafficSign,
                                 street_class::kVegetation,
                                 street_class::kTerrain,
                                 street_class::kCar};
  EXPECT_EQ(labels, expected);
}

TEST(Street, VertexAttributesAreFiniteAndNormalsUnit) {
  const Street& street = short_street();
  ASSERT_EQ(street.texture.size(), street.mesh.vertices.size());
  ASSERT_EQ(street.normals.size(), street.mesh.vertices.size());
  for (std::size_t v = 0; v < street.texture.size(); ++v) {
    EXPECT_TRUE(street.texture[v].allFinite());
    EXPECT_NEAR(street.normals[v].norm(), 1.0F, 1e-4F) << "vertex " << v;
  }
}

TEST(Street, PartsCoverTheMeshAndShareNothing) {
  const Street& street = short_street();
  std::uint32_t vertices = 0;
  std::uint32_t facets = 0;
  for (const StreetPart& part : street.parts) {
    ASSERT_EQ(part.first_vertex, vertices);
    ASSERT_EQ(part.first_facet, facets);
    vertices += part.vertex_count;
    facets += part.facet_count;
    for (std::uint32_t f = part.first_facet; f < facets; ++f) {
      for (const std::uint32_t v : street.mesh.triangles[f]) {
        ASSERT_TRUE(v >= part.first_vertex && v < vertices);
        ASSERT_LE((street.mesh.vertices[v] - part.center).norm(), part.radius + 1e-9);
      }
    }
  }
  EXPECT_EQ(vertices, street.mesh.vertices.size());
  EXPECT_EQ(facets, street.mesh.triangles.size());
}

TEST(Street, StartsLevelAtTheOrigin) {
  Eigen::Matrix3d map_from_optical;
  map_from_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Isometry3d& first = short_street().trajectory.front().map_from_left;
  EXPECT_EQ(first.translation().norm(), 0.0);
  EXPECT_EQ((first.linear() - map_from_optical).norm(), 0.0);
}

TEST(Street, CameraKeepsItsHeightAboveTheRoad) {
  const Street& street = short_street();
  const StreetRaycaster raycaster(street);
  for (const StreetPose& pose : street.trajectory) {
    const auto hit = raycaster.cast(pose.map_from_left.translation(), -Eigen::Vector3d::UnitZ());
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(street.mesh.labels[hit->facet], street_class::kRoad);
    EXPECT_NEAR(hit->distance, 1.65, 0.04);
  }
}

TEST(Street, DrivesOneSpacingPerFrameAndStaysRigid) {
  const Street& street = short_street();
  ASSERT_GE(street.trajectory.size(), 10U);
  for (std::size_t k = 1; k < street.trajectory.size(); ++k) {
    const Eigen::Isometry3d& now = street.trajectory[k].map_from_left;
    const Eigen::Isometry3d& before = street.trajectory[k - 1].map_from_left;
    EXPECT_NEAR((now.translation() - before.translation()).norm(), 1.1, 0.05);
    EXPECT_TRUE(is_rigid(now, 1e-9));
    EXPECT_NEAR(street.trajectory[k].stamp - street.trajectory[k - 1].stamp, 0.1, 1e-9);
  }
}

TEST(Street, KerbIsAsHighAsAsked) {
  StreetConfig config;
  config.length_m = 20.0;
  config.car_density = 0.0;
  config.kerb_height_m = 0.12;
  const Street street = make_street(config);
  const StreetRaycaster raycaster(street);
  // Straight street: the left kerb stands 5.2 m left of the road's middle, that is 6.5 m left of
  // the origin.
  const auto ground = [&](double y) {
    return 1.0 - raycaster.cast({2.0, y, 1.0}, -Eigen::Vector3d::UnitZ())->distance;
  };
  EXPECT_NEAR(ground(6.55) - ground(6.45), 0.12, 0.01);
}

TEST(Street, SameSeedSameStreet) {
  StreetConfig config;
  config.length_m = 20.0;
  const Street a = make_street(config);
  const Street b = make_street(config);
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.labels, b.mesh.labels);
  config.seed = 2;
  EXPECT_NE(a.mesh.vertices, make_street(config).mesh.vertices);
}

TEST(Street, LengthAddsParts) {
  StreetConfig config;
  config.length_m = 400.0;
  config.bend_rad = 0.2;
  const Street street = make_street(config);
  EXPECT_GT(street.mesh.triangles.size(), 6 * short_street().mesh.triangles.size());
  EXPECT_GT(street.trajectory.back().map_from_left.translation().x(), 370.0);
  EXPECT_GT(street.trajectory.size(), 340U);
}

TEST(Street, NamesAllProblemsOfAConfiguration) {
  StreetConfig config;
  config.length_m = std::nan("");
  config.car_density = 2.0;
  try {
    make_street(config);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("length_m"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("car_density"), std::string::npos);
  }
}

TEST(Street, RefusesMoreFramesThanFit) {
  StreetConfig config;
  config.length_m = 30.0;
  config.frames = 15;
  EXPECT_EQ(make_street(config).trajectory.size(), 15U);
  config.frames = 16;
  EXPECT_THROW(make_street(config), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
