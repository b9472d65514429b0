// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/chunk_store.h"

#include <set>

#include "chunk_messages.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using Result = ChunkStore::Result;

std::set<std::int32_t> take_all_changed(ChunkStore* store) {
  std::set<std::int32_t> keys;
  while (const auto chunk = store->take_changed()) {
    keys.insert(chunk->key[0]);
  }
  return keys;
}

std::set<std::int32_t> take_all_removed(ChunkStore* store) {
  std::set<std::int32_t> keys;
  while (const auto key = store->take_removed()) {
    keys.insert((*key)[0]);
  }
  return keys;
}

ChunkStore three_chunks() {
  ChunkStore store;
  store.apply(mesh_message(4, true, {unit_square(0), unit_square(1), unit_square(2)}));
  take_all_changed(&store);
  return store;
}

TEST(ChunkStore, AFullMeshMakesEveryChunkDue) {
  ChunkStore store;
  EXPECT_EQ(store.apply(mesh_message(4, true, {unit_square(0), unit_square(1)})), Result::kApplied);
  EXPECT_EQ(store.waiting(), 2U);
  EXPECT_EQ(store.size(), 2U);
  EXPECT_EQ(store.frame_id(), "map");
  EXPECT_EQ(take_all_changed(&store), (std::set<std::int32_t>{0, 1}));
  EXPECT_FALSE(store.take_changed());
}

TEST(ChunkStore, ADeltaMakesOnlyItsChunksDue) {
  ChunkStore store = three_chunks();
  LabeledMesh delta = mesh_message(5, false, {unit_square(1, 2), unit_square(7)});
  delta.removed_keys = {2, 0, 0};
  EXPECT_EQ(store.apply(std::move(delta)), Result::kApplied);
  EXPECT_EQ(take_all_changed(&store), (std::set<std::int32_t>{1, 7}));
  EXPECT_EQ(take_all_removed(&store), (std::set<std::int32_t>{2}));
  EXPECT_EQ(store.sequence(), 5U);
}

TEST(ChunkStore, AMissedMessageIsAGapAndLeavesStateAndMessageAlone) {
  ChunkStore store = three_chunks();
  LabeledMesh delta = mesh_message(6, false, {unit_square(1, 2)});
  EXPECT_EQ(store.apply(std::move(delta)), Result::kGap);
  EXPECT_EQ(delta.chunks.size(), 1U);  // NOLINT(bugprone-use-after-move): that is the promise
  EXPECT_EQ(store.sequence(), 4U);
  EXPECT_EQ(store.waiting(), 0U);
}

TEST(ChunkStore, ADeltaBeforeAnyFullMeshOrOfAnotherMapIsAGap) {
  ChunkStore fresh;
  EXPECT_EQ(fresh.apply(mesh_message(1, false, {unit_square(0)})), Result::kGap);
  ChunkStore store = three_chunks();
  EXPECT_EQ(store.apply(mesh_message(5, false, {unit_square(0)}, "another map")), Result::kGap);
}

TEST(ChunkStore, WhatIsOlderThanTheStateIsIgnored) {
  ChunkStore store = three_chunks();
  EXPECT_EQ(store.apply(mesh_message(4, false, {unit_square(1, 9)})), Result::kOld);
  EXPECT_EQ(store.apply(mesh_message(3, true, {})), Result::kOld);
  EXPECT_EQ(store.size(), 3U);
}

TEST(ChunkStore, AFullMeshAfterAGapMakesOnlyWhatWasMissedDue) {
  ChunkStore store = three_chunks();
  store.apply(mesh_message(9, true, {unit_square(0), unit_square(1, 2)}));
  EXPECT_EQ(take_all_changed(&store), (std::set<std::int32_t>{1}));
  EXPECT_EQ(take_all_removed(&store), (std::set<std::int32_t>{2}));
}

TEST(ChunkStore, AnotherMapMakesAllDueThoughRevisionsAgree) {
  ChunkStore store = three_chunks();
  store.apply(mesh_message(1, true, {unit_square(0)}, "another map"));
  EXPECT_EQ(take_all_changed(&store), (std::set<std::int32_t>{0}));
  EXPECT_EQ(take_all_removed(&store), (std::set<std::int32_t>{0, 1, 2}))
      << "nothing of the old map may stay, late as the new one may be";
}

TEST(ChunkStore, AChunkRemovedWhileDueIsNotDrawn) {
  ChunkStore store;
  store.apply(mesh_message(4, true, {unit_square(0)}));
  LabeledMesh delta = mesh_message(5, false, {});
  delta.removed_keys = {0, 0, 0};
  store.apply(std::move(delta));
  EXPECT_FALSE(store.take_changed());
  EXPECT_EQ(store.size(), 0U);
}

TEST(ChunkStore, RemovedKeysOfWrongLengthDoNoHarm) {
  ChunkStore store = three_chunks();
  LabeledMesh delta = mesh_message(5, false, {});
  delta.removed_keys = {0, 0, 0, 1, 0};
  EXPECT_EQ(store.apply(std::move(delta)), Result::kApplied);
  EXPECT_EQ(take_all_removed(&store), (std::set<std::int32_t>{0}));
}

TEST(ChunkStore, ClearTakesEverythingOffTheScreen) {
  ChunkStore store = three_chunks();
  store.clear();
  EXPECT_FALSE(store.has_mesh());
  EXPECT_EQ(take_all_removed(&store), (std::set<std::int32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace facet_mapping
