// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the map says that it holds is what the process has. A program of its own, so that no other
// test's memory is in the sum. FACET_MAPPING_MEMORY_KEYFRAMES=2000 for a long drive with a table.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "support/street_drive.h"
#include <gtest/gtest.h>
#include <malloc.h>

#include "facet_mapping/mapping/chunk_archive.h"
#include "facet_mapping/mapping/labeled_map.h"
#include "facet_mapping/ros/process_memory.h"

namespace facet_mapping {
namespace {

constexpr double kMiB = 1024.0 * 1024.0;

int keyframes() {
  const char* text = std::getenv("FACET_MAPPING_MEMORY_KEYFRAMES");
  return text == nullptr ? 60 : std::atoi(text);
}

MapConfig map_config() {
  MapConfig config;
  config.max_range_m = 30.0;
  config.frozen_beyond_m = 35.0;
  config.carving.steiner_reach_m = 35.0;
  return config;
}

TEST(MapMemory, AccountedBytesAreThoseOfTheProcess) {
  const int count = keyframes();
  const std::vector<PointFrame> drive = test::street_drive(count, 2500, 30.0);
  ClassInfo road;
  road.name = "road";
  LabeledMap map(LabelSet({road}), map_config());
  ChunkedMesh chunks(8.0);
  ChunkArchive archive("");
  malloc_trim(0);
  const std::uint64_t start = process_memory().own();
  double worst = 0.0;
  std::printf("keyframe  accounted MiB  resident MiB  frozen chunks\n");
  for (int k = 0; k < count; ++k) {
    map.add(drive[static_cast<std::size_t>(k)]);
    map.update();
    ChunkDelta delta = chunks.update(map.mesh(), map.surface().vertex_ids, map.freeze_line());
    archive.add(std::move(delta.frozen));
    delta = {};
    malloc_trim(0);
    const ProcessMemory memory = process_memory();
    const double accounted =
        static_cast<double>(start + memory.shared + map.bytes() + chunks.bytes() + archive.bytes());
    const double resident = static_cast<double>(memory.resident);
    if ((k + 1) % std::max(1, count / 20) == 0) {
      std::printf(
          "%8d  %13.1f  %12.1f  %13zu\n", k + 1, accounted / kMiB, resident / kMiB, archive.size());
    }
    worst = std::max(worst, std::abs(accounted / resident - 1.0));
  }
  std::printf("largest difference: %.1f %%\n", 100.0 * worst);
  EXPECT_GT(archive.size(), 5U);
  EXPECT_LT(worst, 0.1);
}

}  // namespace
}  // namespace facet_mapping
