// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/io/atomic_file.h"

#include <csignal>

#include "io/temp_folder.h"
#include "support/small_disk.h"
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace facet_mapping {
namespace {

using testing::error_of;
using testing::read_text;
using testing::TempFolder;
using testing::write_text;

TEST(AtomicFile, AppearsOnCommitOnly) {
  const TempFolder folder;
  const std::string path = folder / "a/b/file.txt";
  AtomicFile file(path);
  file.write("hello");
  EXPECT_FALSE(std::filesystem::exists(path));
  file.commit();
  EXPECT_EQ(read_text(path), "hello");
  EXPECT_EQ(folder.files(), 3U);  // a, b and the file: nothing temporary is left
}

TEST(AtomicFile, WithoutCommitTheOldFileStays) {
  const TempFolder folder;
  const std::string path = folder / "file.txt";
  write_text(path, "old");
  {
    AtomicFile file(path);
    file.write("new");
  }
  EXPECT_EQ(read_text(path), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, TwoWritersDoNotMeet) {
  const TempFolder folder;
  const std::string path = folder / "file.txt";
  AtomicFile first(path);
  AtomicFile second(path);
  first.write("first");
  second.write("second");
  first.commit();
  second.commit();
  EXPECT_EQ(read_text(path), "second");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, FullDiskIsAnErrorAndTheOldFileStays) {
  const TempFolder folder;
  const std::string path = folder / "file.txt";
  write_text(path, "old");
  std::string error;
  {
    const testing::SmallDisk disk(4096);
    error = error_of([&] {
      AtomicFile file(path);
      file.write(std::string(10000, 'x'));
      file.commit();
    });
  }
  EXPECT_NE(error.find(path), std::string::npos) << error;
  EXPECT_NE(error.find("File too large"), std::string::npos) << error;
  EXPECT_EQ(read_text(path), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, UnwritablePlacesAreNamed) {
  const TempFolder folder;
  write_text(folder / "file", "");
  const std::string below_file = folder / "file/below.ply";
  EXPECT_NE(error_of([&] { const AtomicFile f(below_file); }).find("cannot make the folder"),
            std::string::npos);
  EXPECT_NE(error_of([&] { const AtomicFile f(folder.path().string()); }).find("it is a folder"),
            std::string::npos);
  EXPECT_NE(error_of([&] { const AtomicFile f(""); }).find("without a name"), std::string::npos);
  EXPECT_NE(error_of([&] { const AtomicFile f("/proc/no/file"); }).find("cannot make the folder"),
            std::string::npos);
}

TEST(AtomicFile, PublishReplacesAndNamesAMissingTemporary) {
  const TempFolder folder;
  const std::string path = folder / "file.txt";
  write_text(path, "old");
  const std::string temporary = temporary_beside(path);
  EXPECT_EQ(std::filesystem::path(temporary).parent_path(), folder.path());
  write_text(temporary, "new");
  publish_file(temporary, path);
  EXPECT_EQ(read_text(path), "new");
  EXPECT_NE(error_of([&] { publish_file(temporary, path); }).find(path), std::string::npos);
}

}  // namespace
}  // namespace facet_mapping
