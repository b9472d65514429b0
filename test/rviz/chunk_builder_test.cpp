// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/chunk_builder.h"

#include <chrono>
#include <limits>
#include <map>
#include <thread>

#include "chunk_messages.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

/// By ticket.
std::map<std::uint64_t, BuiltChunk> take_all(ChunkBuilder* builder) {
  std::map<std::uint64_t, BuiltChunk> taken;
  while (builder->under_way() > 0) {
    if (std::optional<BuiltChunk> built = builder->take()) {
      taken[built->ticket] = std::move(*built);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  return taken;
}

TEST(ChunkBuilder, EveryChunkComesBackAsIfMadeAtOnce) {
  ChunkBuilder builder;
  ClassTable classes;
  for (int k = 0; k < 200; ++k) {
    LabeledMeshChunk chunk = unit_square(k);
    chunk.origin.x = 2.0 * k;
    ClassSlots slots = classes.slots_of(chunk.labels);
    builder.submit(std::move(chunk), std::move(slots), static_cast<std::uint64_t>(k));
  }
  const auto taken = take_all(&builder);
  ASSERT_EQ(taken.size(), 200U);
  for (const auto& [ticket, built] : taken) {
    const LabeledMeshChunk given = unit_square(static_cast<std::int32_t>(ticket));
    const ChunkGeometry expected = make_chunk_geometry(given, classes.slots_of(given.labels));
    EXPECT_EQ(built.key[0], static_cast<std::int32_t>(ticket));
    EXPECT_EQ(built.origin.x(), 2.0 * static_cast<double>(ticket));
    EXPECT_EQ(built.geometry.indices, expected.indices);
    ASSERT_EQ(built.vertices.size(), expected.vertices.size());
    for (std::size_t k = 0; k < expected.vertices.size(); ++k) {
      const FacetVertex unpacked = built.packing.unpack(built.vertices[k]);
      EXPECT_EQ(unpacked.position, expected.vertices[k].position);
      EXPECT_EQ(unpacked.facet, expected.vertices[k].facet);
    }
  }
}

class ChunkOrigin : public ::testing::TestWithParam<double> {};

TEST_P(ChunkOrigin, ThatIsNoPlaceLeavesAllFacetsOut) {
  ChunkBuilder builder;
  LabeledMeshChunk chunk = unit_square(0);
  chunk.origin.y = GetParam();
  ClassTable classes;
  ClassSlots slots = classes.slots_of(chunk.labels);
  builder.submit(std::move(chunk), std::move(slots), 7);
  const auto taken = take_all(&builder);
  EXPECT_EQ(taken.at(7).geometry.bad_facets, 2U);
  EXPECT_TRUE(taken.at(7).geometry.indices.empty());
}

INSTANTIATE_TEST_SUITE_P(ChunkBuilder,
                         ChunkOrigin,
                         ::testing::Values(std::numeric_limits<double>::infinity(),
                                           std::numeric_limits<double>::quiet_NaN(),
                                           1.0e30,
                                           -1.0e305));

TEST(ChunkBuilder, EndsWithWorkLeft) {
  ChunkBuilder builder;
  ClassTable classes;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    builder.submit(unit_square(0), classes.slots_of({5, 6}), k);
  }
  SUCCEED() << "the destructor returns";
}

}  // namespace
}  // namespace facet_mapping
