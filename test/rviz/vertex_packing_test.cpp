// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/vertex_packing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

Eigen::AlignedBox3f cube(float half_size_m) {
  return {Eigen::Vector3f::Constant(-half_size_m), Eigen::Vector3f::Constant(half_size_m)};
}

TEST(VertexPacking, PositionsComeBackWithinHalfAStep) {
  std::mt19937 random(3);
  for (const float half_size : {0.1F, 4.0F, 7.9F, 60.0F, 5000.0F}) {
    const Eigen::Vector3d origin(8.0, -816.3, 0.4);
    const VertexPacking packing(origin, cube(half_size));
    std::uniform_real_distribution<float> place(-half_size, half_size);
    for (int k = 0; k < 200; ++k) {
      FacetVertex vertex;
      vertex.position = {place(random), place(random), k == 0 ? half_size : place(random)};
      const FacetVertex back = packing.unpack(packing.pack(vertex));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(back.position[axis], vertex.position[axis], 0.5 * packing.step_m() + 1.0e-4);
      }
    }
  }
}

TEST(VertexPacking, StepsAreFineForUsualChunks) {
  EXPECT_DOUBLE_EQ(VertexPacking({}, cube(7.9F)).step_m(), 1.0 / 4096.0);
  EXPECT_LT(VertexPacking({}, cube(60.0F)).step_m(), 0.004);
}

TEST(VertexPacking, ChunksSideBySideRoundWhatTheyShareAlike) {
  const Eigen::Vector3d left_origin(-8.0, 0.0, 0.0);
  const Eigen::Vector3d right_origin(0.0, 0.0, 0.0);
  const Eigen::AlignedBox3f left_box(Eigen::Vector3f(1.3F, 0.2F, -1.0F),
                                     Eigen::Vector3f(8.4F, 7.0F, 2.0F));
  const Eigen::AlignedBox3f right_box(Eigen::Vector3f(-0.6F, 0.1F, -2.0F),
                                      Eigen::Vector3f(8.1F, 8.0F, 1.0F));
  const VertexPacking left(left_origin, left_box);
  const VertexPacking right(right_origin, right_box);
  for (int k = 0; k < 100; ++k) {
    // Sixteenths of a millimetre off the grid's ties, exact in both chunks' floats.
    const float y = 1.0F + 0.0625F * static_cast<float>(k) + 1.0F / 16384.0F;
    FacetVertex in_left;
    in_left.position = {8.0F, y, 0.5F};
    FacetVertex in_right;
    in_right.position = {0.0F, y, 0.5F};
    const FacetVertex a = left.unpack(left.pack(in_left));
    const FacetVertex b = right.unpack(right.pack(in_right));
    EXPECT_EQ(a.position[0] - 8.0F, b.position[0]);
    EXPECT_EQ(a.position[1], b.position[1]);
    EXPECT_EQ(a.position[2], b.position[2]);
  }
}

TEST(VertexPacking, NormalsComeBackWithinADegreeOrSo) {
  const VertexPacking packing({}, cube(1.0F));
  std::mt19937 random(5);
  std::normal_distribution<double> component;
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d unit =
        Eigen::Vector3d(component(random), component(random), component(random)).normalized();
    FacetVertex vertex;
    for (int axis = 0; axis < 3; ++axis) {
      vertex.normal[static_cast<std::size_t>(axis)] =
          static_cast<std::int8_t>(std::lround(127.0 * unit[axis]));
    }
    const FacetVertex back = packing.unpack(packing.pack(vertex));
    const Eigen::Vector3d seen =
        Eigen::Vector3d(back.normal[0], back.normal[1], back.normal[2]).normalized();
    EXPECT_GT(seen.dot(unit), std::cos(1.5 / 57.3));
  }
}

TEST(VertexPacking, NormalsAlongTheAxesAreExact) {
  const VertexPacking packing({}, cube(1.0F));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int8_t value : {std::int8_t{127}, std::int8_t{-127}}) {
      FacetVertex vertex;
      vertex.normal[axis] = value;
      EXPECT_EQ(packing.unpack(packing.pack(vertex)).normal, vertex.normal);
    }
  }
}

TEST(VertexPacking, AttributesStayAndNothingIsNoFault) {
  FacetVertex vertex;
  vertex.facet = {1, 20, 255, 11};
  const VertexPacking packing(Eigen::Vector3d(1.0e6, 0.0, 0.0), Eigen::AlignedBox3f());
  EXPECT_EQ(packing.unpack(packing.pack(vertex)).facet, vertex.facet);
}

}  // namespace
}  // namespace facet_mapping
