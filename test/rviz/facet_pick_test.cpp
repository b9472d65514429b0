// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/facet_pick.h"

#include <cmath>
#include <random>

#include "chunk_messages.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

class FacetPick : public ::testing::Test {
 protected:
  FacetPick() {
    LabeledMeshChunk chunk = unit_square(0);  // facets of classes 5 (below y = x) and 6
    geometry_ = make_chunk_geometry(chunk, classes_.slots_of(chunk.labels));
    filter_.shown.assign(ClassTable::kSlots, true);
  }

  std::optional<FacetHit> pick(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    return nearest_facet(PickRay::Through(from, to),
                         filter_,
                         Eigen::Vector3d(100.0, 200.0, 3.0),
                         geometry_.vertices,
                         geometry_.indices);
  }
  std::optional<FacetHit> pick_from_above(double x, double y) const {
    return pick({100.0 + x, 200.0 + y, 13.0}, {100.0 + x, 200.0 + y, 0.0});
  }

  ClassTable classes_;
  ChunkGeometry geometry_;
  PickFilter filter_;
};

TEST_F(FacetPick, TellsWhichFacetItIsAndWhatItCarries) {
  const auto lower = pick_from_above(0.7, 0.2);
  const auto upper = pick_from_above(0.2, 0.7);
  ASSERT_TRUE(lower && upper);
  EXPECT_EQ(classes_.styles()[lower->attributes[0]].id, 5);
  EXPECT_EQ(classes_.styles()[upper->attributes[0]].id, 6);
  EXPECT_EQ(lower->attributes[1], 100);
  EXPECT_EQ(upper->attributes[2], 255);
  EXPECT_DOUBLE_EQ(lower->distance, 10.0);
  EXPECT_TRUE(lower->cross().isApprox(Eigen::Vector3d::UnitZ()));
}

TEST_F(FacetPick, MissesWhatLiesBesideOrBehind) {
  EXPECT_FALSE(pick_from_above(1.2, 0.5));
  EXPECT_FALSE(pick({100.5, 200.5, 13.0}, {100.5, 200.5, 20.0}));
  EXPECT_FALSE(pick({90.0, 200.5, 3.0}, {110.0, 200.5, 3.0})) << "along the surface";
}

TEST_F(FacetPick, MissesWhatIsNotDrawn) {
  filter_.shown[classes_.slot_of(5)] = false;
  EXPECT_FALSE(pick_from_above(0.7, 0.2));
  EXPECT_TRUE(pick_from_above(0.2, 0.7));
  filter_.shown.assign(ClassTable::kSlots, true);
  filter_.min_confidence = 150;
  EXPECT_FALSE(pick_from_above(0.7, 0.2));
  filter_.min_confidence = 0;
  filter_.min_views = 4;
  EXPECT_FALSE(pick_from_above(0.7, 0.2));
  EXPECT_TRUE(pick_from_above(0.2, 0.7));
  filter_.min_views = 0;
  filter_.eye = {100.7, 200.2, 13.0};
  filter_.max_distance = 9.9;
  EXPECT_FALSE(pick_from_above(0.7, 0.2));
  filter_.max_distance = 10.1;
  EXPECT_TRUE(pick_from_above(0.7, 0.2));
  filter_.max_height = 2.9;
  EXPECT_FALSE(pick_from_above(0.7, 0.2));
}

TEST_F(FacetPick, SeesBackFacesUnlessTheyAreCulled) {
  EXPECT_TRUE(pick({100.7, 200.2, -5.0}, {100.7, 200.2, 5.0}));
  filter_.cull_back_faces = true;
  EXPECT_FALSE(pick({100.7, 200.2, -5.0}, {100.7, 200.2, 5.0}));
  EXPECT_TRUE(pick_from_above(0.7, 0.2));
}

TEST_F(FacetPick, TheNearestOfSeveralIsHit) {
  LabeledMeshChunk chunk = unit_square(0);
  for (int level = 1; level < 6; ++level) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      geometry_msgs::Point32 v = chunk.vertices[k];
      v.z = static_cast<float>(level);
      chunk.vertices.push_back(v);
    }
    const auto base = static_cast<std::uint32_t>(4 * level);
    chunk.triangles.insert(chunk.triangles.end(), {base, base + 1, base + 2});
  }
  chunk.labels.clear();
  chunk.confidence.clear();
  chunk.views.clear();
  geometry_ = make_chunk_geometry(chunk, classes_.slots_of({}));
  EXPECT_DOUBLE_EQ(pick_from_above(0.7, 0.2)->distance, 5.0);
}

TEST(EntryDistance, AgreesWithSamplesAlongTheRay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  const auto point = [&] { return Eigen::Vector3d(place(random), place(random), place(random)); };
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1.0, -0.5, 0.0), Eigen::Vector3d(1.0, 1.5, 0.7));
  int hits = 0;
  for (int k = 0; k < 300; ++k) {
    const PickRay ray = PickRay::Through(point(), point());
    double sampled = -1.0;
    for (double t = 0.0; t < 12.0 && sampled < 0.0; t += 0.002) {
      sampled = box.contains(ray.pointAt(t)) ? t : -1.0;
    }
    const std::optional<double> entry = entry_distance(ray, box);
    if (sampled >= 0.0) {
      ASSERT_TRUE(entry);
      EXPECT_NEAR(*entry, sampled, 0.003);
      ++hits;
    } else if (entry) {  // a corner cut between two samples
      EXPECT_TRUE(Eigen::AlignedBox3d(box.min().array() - 0.003, box.max().array() + 0.003)
                      .contains(ray.pointAt(*entry)));
    }
  }
  EXPECT_GT(hits, 20);
}

TEST(EntryDistance, ARayAlongAnAxisNeedsNoDivision) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_EQ(entry_distance(PickRay({0.5, 0.5, -2.0}, up), box), 2.0);
  EXPECT_EQ(entry_distance(PickRay({0.5, 0.5, 0.5}, up), box), 0.0);
  EXPECT_EQ(entry_distance(PickRay({1.5, 0.5, -2.0}, up), box), std::nullopt);
  EXPECT_EQ(entry_distance(PickRay({0.5, 0.5, 2.0}, up), box), std::nullopt);
}

}  // namespace
}  // namespace facet_mapping
