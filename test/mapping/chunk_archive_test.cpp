// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/chunk_archive.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

#include "io/temp_folder.h"
#include "support/small_disk.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

/// Any bits, not-a-number among them: an archive must not care.
MeshChunk random_chunk(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  MeshChunk chunk;
  chunk.key = {static_cast<std::int32_t>(seed), -7, 1 - static_cast<std::int32_t>(random() % 99)};
  chunk.revision = static_cast<std::uint32_t>(random());
  chunk.origin = {8.0 * seed, 1.0 / 3.0, -0.0};
  for (unsigned v = 0; v < 50; ++v) {
    chunk.vertices.emplace_back(normal(random), normal(random), normal(random));
    chunk.vertex_ids.push_back(static_cast<std::uint32_t>(random()));
  }
  for (unsigned f = 0; f < 80; ++f) {
    chunk.triangles.push_back({f % 50U, 3U * f % 50U, (7U * f + 1U) % 50U});
    chunk.labels.push_back(static_cast<Label>(random() % 20));
    chunk.confidence.push_back(static_cast<std::uint8_t>(random()));
  }
  return chunk;  // views stays empty
}

std::vector<MeshChunk> read_all(const ChunkArchive& archive) {
  std::vector<MeshChunk> chunks;
  archive.for_each([](const ChunkKey&) { return true; },
                   [&](const MeshChunk& chunk) { chunks.push_back(chunk); });
  std::sort(chunks.begin(), chunks.end(), [](const MeshChunk& a, const MeshChunk& b) {
    return a.key < b.key;
  });
  return chunks;
}

TEST(ChunkArchive, ReadsBackBitForBit) {
  const TempFolder folder;
  ChunkArchive archive(folder.path());
  std::vector<MeshChunk> chunks;
  for (unsigned seed = 0; seed < 40; ++seed) {
    chunks.push_back(random_chunk(seed));
    if (seed % 4 == 3) {
      archive.add({chunks.end() - 4, chunks.end()});
    }
  }
  EXPECT_EQ(archive.size(), 40U);
  EXPECT_EQ(archive.unwritten(), 0U);
  EXPECT_EQ(archive.totals().facets, 40U * 80U);
  EXPECT_EQ(read_all(archive), chunks);
  EXPECT_LT(archive.bytes(), archive.bytes_on_disk() / 4);
  std::size_t visited = 0;
  archive.for_each([](const ChunkKey& key) { return key[0] == 11; },
                   [&](const MeshChunk& chunk) {
                     ++visited;
                     EXPECT_EQ(chunk, chunks[11]);
                   });
  EXPECT_EQ(visited, 1U);
}

TEST(ChunkArchive, NothingIsLeftBehind) {
  const TempFolder folder;
  {
    ChunkArchive archive(folder.path());
    EXPECT_EQ(folder.files(), 0U);  // nothing is made before it is needed
    archive.add({random_chunk(1)});
    EXPECT_GT(folder.files(), 0U);
    archive.clear();
    EXPECT_EQ(folder.files(), 0U);
    EXPECT_EQ(archive.size(), 0U);
    archive.add({random_chunk(1), random_chunk(2)});
    EXPECT_EQ(read_all(archive).size(), 2U);
  }
  EXPECT_EQ(folder.files(), 0U);
}

TEST(ChunkArchive, FoldersOfKilledProcessesAreRemovedAndThoseInUseAreNot) {
  const TempFolder folder;
  fs::create_directories(folder / "facet_mapping_archive_killed");
  std::ofstream(folder / "facet_mapping_archive_killed/in_use").flush();
  fs::create_directories(folder / "something_else");
  ChunkArchive first(folder.path());
  first.add({random_chunk(1)});
  ChunkArchive second(folder.path());
  second.add({random_chunk(2)});
  EXPECT_FALSE(fs::exists(folder / "facet_mapping_archive_killed"));
  EXPECT_TRUE(fs::exists(folder / "something_else"));
  EXPECT_EQ(read_all(first).size(), 1U);
}

TEST(ChunkArchive, AFullDiskLosesNothingAndIsReportedOnce) {
  const TempFolder folder;
  std::vector<std::string> problems;
  ChunkArchive archive(folder.path(),
                       [&](const std::string& sentence) { problems.push_back(sentence); });
  archive.add({random_chunk(1)});
  {
    const testing::SmallDisk small(100);
    archive.add({random_chunk(2)});
    archive.add({random_chunk(3)});
    EXPECT_EQ(archive.unwritten(), 2U);
    EXPECT_GT(archive.bytes(), random_chunk(2).bytes());
    EXPECT_EQ(read_all(archive),
              (std::vector<MeshChunk>{random_chunk(1), random_chunk(2), random_chunk(3)}));
  }
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("archive_folder"), std::string::npos);
  archive.add({random_chunk(4)});  // there is room again
  EXPECT_EQ(archive.unwritten(), 0U);
  EXPECT_EQ(read_all(archive).size(), 4U);
}

TEST(ChunkArchive, AFolderThatCannotBeMadeLosesNothing) {
  const TempFolder folder;
  testing::write_text(folder / "file", "not a folder");
  std::size_t problems = 0;
  ChunkArchive archive(folder / "file", [&](const std::string&) { ++problems; });
  archive.add({random_chunk(1)});
  archive.add({random_chunk(2)});
  EXPECT_EQ(problems, 1U);
  EXPECT_EQ(read_all(archive), (std::vector<MeshChunk>{random_chunk(1), random_chunk(2)}));
}

TEST(ChunkArchive, DamageIsNoticedAndTheRestHandedOut) {
  const TempFolder folder;
  ChunkArchive archive(folder.path());
  archive.add({random_chunk(1)});
  archive.add({random_chunk(2)});
  std::fstream file(archive.folder() + "/0.chunks",
                    std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(200);
  file.put('\x55');
  file.close();
  std::vector<MeshChunk> read;
  const auto read_on = [&] {
    archive.for_each([](const ChunkKey&) { return true; },
                     [&](const MeshChunk& chunk) { read.push_back(chunk); });
  };
  EXPECT_THROW(read_on(), std::runtime_error);
  EXPECT_EQ(read, std::vector<MeshChunk>{random_chunk(2)});
  fs::remove(archive.folder() + "/1.chunks");
  EXPECT_THROW(read_on(), std::runtime_error);
}

}  // namespace
}  // namespace facet_mapping
