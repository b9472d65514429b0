// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is wrong with a folder is named, all of it at once.
#include "io/temp_folder.h"
#include "support/damaged_dataset.h"
#include "support/small_datasets.h"
#include <gtest/gtest.h>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {
namespace {

using testing::check;
using testing::error_of;
using testing::Maker;
using testing::remove_file;
using testing::replace;
using testing::TempFolder;
using testing::write_file;
using testing::write_text;

TEST(BrokenDataset, PlainLayout) {
  const Maker make = [](const std::string& folder) {
    testing::make_plain(folder);
    return folder;
  };
  const std::string unit = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  check(
      make,
      {{remove_file("poses.txt"), {"missing: ", "/poses.txt"}},
       {remove_file("times.txt"), {"missing: ", "/times.txt", "(1 problem)"}},
       {remove_file("calib.txt"), {"missing: ", "/calib.txt", "(1 problem)"}},
       {remove_file("left/000000.png"), {"missing: ", "/left/000000.png", "(1 problem)"}},
       {remove_file("left/000001.png"), {"missing: ", "/left/000001.png", "(1 problem)"}},
       {remove_file("left/000002.png"), {"missing: ", "/left/000002.png", "(1 problem)"}},
       {remove_file("right/000001.png"), {"missing: ", "/right/000001.png"}},
       {write_file("poses.txt", ""), {"/poses.txt is empty"}},
       {write_file("poses.txt", unit + unit), {"holds 3 images, but poses.txt has 2 entries"}},
       {write_file("times.txt", "0\n0.1\n"), {"/times.txt has 2 times for 3 frames"}},
       {write_file("times.txt", "0\n0.1\n0.1\n"), {"/times.txt line 3 is not later"}},
       {write_file("times.txt", "0\nsoon\n0.2\n"), {"/times.txt line 2 holds a word"}},
       {replace("poses.txt", "0 0 1 1", "0 0 1 nan"), {"/poses.txt line 2 holds NaN"}},
       {replace("poses.txt", "0 0 1 1", "0 0 1"),
        {"/poses.txt line 2 holds 11 numbers instead of 12"}},
       {replace("poses.txt", "0 0 1 1", "0 0 2 1"), {"/poses.txt line 2 is no rigid transform"}},
       {replace("poses.txt", "0 0 1 1", "0 0 -1 1"), {"/poses.txt line 2 is no rigid transform"}},
       {replace("calib.txt", "K:", "L:"), {"/calib.txt has no line 'K:' with 9 numbers"}},
       {replace("calib.txt", "K: 10 0", "K: 10 1"), {"needs positive focal lengths and no skew"}},
       {replace("calib.txt", "K: 10 0", "K: -10 0"), {"needs positive focal lengths and no skew"}},
       {replace("calib.txt", "K: 10 0", "K: 10"), {"'K' holds 8 numbers instead of 9"}},
       {replace("calib.txt", "T_right_left: 1", "T_right_left: 2"),
        {"'T_right_left' is no rigid transform"}},
       {replace("calib.txt", "-0.5", "0.5"), {"must stand at positive x", "contradicts"}},
       {replace("calib.txt", "baseline_m: 0.5", "baseline_m: 0.6"),
        {"baseline_m 0.6", "contradicts"}},
       {replace("calib.txt", "T_left_velo", "T_velo"), {"no line 'T_left_velo:'"}},
       {write_file("left/000000.png", "no image"), {"/left/000000.png' is truncated"}},
       {write_file("left/cover.png", ""), {"holds 4 images, but poses.txt has 3 entries"}}});
}

TEST(BrokenDataset, KittiOdometry) {
  const Maker make = [](const std::string& folder) {
    testing::make_odometry(folder);
    return folder;
  };
  check(make,
        {{remove_file("poses.txt"), {"missing: ", "/poses.txt"}},
         {remove_file("image_3/000002.png"), {"missing: ", "/image_3/000002.png"}},
         {replace("calib.txt", "P2:", "P9:"), {"no line 'P2:' with 12 numbers"}},
         {replace("calib.txt", "P3: 10 0 4 -4.4", "P3: 11 0 4 -4.4"), {"camera matrix differ"}},
         {replace("calib.txt", "-4.4", "4.4"), {"must stand at positive x"}},
         {replace("calib.txt", "Tr:", "Trx:"), {"no line 'Tr:' with 12 numbers"}}});
}

TEST(BrokenDataset, KittiRaw) {
  const Maker make = [](const std::string& folder) { return testing::make_raw(folder); };
  check(make,
        {{remove_file("image_02/timestamps.txt"), {"missing: ", "/image_02/timestamps.txt"}},
         {remove_file("oxts/data/0000000001.txt"), {"missing: ", "/oxts/data/0000000001.txt"}},
         {remove_file("image_02/data/0000000001.png"), {"/image_02/data/0000000001.png"}},
         {remove_file("../calib_cam_to_cam.txt"), {"missing: ", "/calib_cam_to_cam.txt"}},
         {remove_file("../calib_velo_to_cam.txt"), {"missing: ", "/calib_velo_to_cam.txt"}},
         {remove_file("../calib_imu_to_velo.txt"), {"missing: ", "/calib_imu_to_velo.txt"}},
         {write_file("oxts/data/0000000001.txt", "49 8 110\n"),
          {"line 1 holds 3 numbers instead of 30"}},
         {replace("oxts/data/0000000001.txt", "110.0", "nan"), {"0000000001.txt line 1 holds NaN"}},
         {replace("../calib_cam_to_cam.txt", "R_rect_00: 1", "R_rect_00: 3"),
          {"'R_rect_00' is no rotation"}},
         {replace("../calib_velo_to_cam.txt", "R: 0 -1", "R: 0 1"), {"'R' is no rotation"}},
         {replace("image_02/timestamps.txt", "2011-09-26 13:02:26", "yesterday"),
          {"/image_02/timestamps.txt line 2 is no time"}},
         {replace("image_02/timestamps.txt", "13:02:26", "13:02:24"), {"line 2 is not later"}}});
}

TEST(BrokenDataset, Strecha) {
  const Maker make = [](const std::string& folder) {
    testing::make_strecha(folder);
    return folder;
  };
  check(make,
        {{write_file("cameras.json", ""), {"/cameras.json: ", "parse error"}},
         {write_file("cameras.json", "{\"views\": [ {"), {"/cameras.json: ", "parse error"}},
         {write_file("cameras.json", "{}"), {"/cameras.json: ", "'views' not found"}},
         {write_file("cameras.json", "{\"views\": []}"), {"must be a list that is not empty"}},
         {replace("cameras.json", "\"fx\"", "\"f\""), {"view 0: ", "'fx' not found"}},
         {replace("cameras.json", "\"fx\": 10", "\"fx\": 0"), {"view 0: ", "must be positive"}},
         {replace("cameras.json", "[0,-1,0]", "[0,-2,0]"), {"view 1: its pose is no rigid"}},
         {replace("cameras.json", "[2,-1,-3]", "[2,-1]"), {"view 1: "}},
         {replace("cameras.json", "[2,-1,-3]", "[2,-1,null]"), {"view 1: "}},
         {remove_file("images/0001.png"), {"missing: ", "/images/0001.png"}}});
}

TEST(BrokenDataset, ManyProblemsAreCounted) {
  const TempFolder folder;
  testing::make_plain(folder.path().string());
  std::string poses;
  std::string times;
  for (int k = 0; k < 20; ++k) {
    poses += "1 0 0 0 0 1 0 0 0 0 1 0\n";
    times += std::to_string(k) + "\n";
  }
  write_text(folder / "poses.txt", poses);
  write_text(folder / "times.txt", times);
  const std::string error = error_of([&] { read_dataset(folder.path().string()); });
  EXPECT_NE(error.find("(34 problems)"), std::string::npos) << error;  // 17 left, 17 right images
  EXPECT_NE(error.find("left/000003.png"), std::string::npos) << error;
  EXPECT_NE(error.find("and 24 more"), std::string::npos) << error;
}

TEST(BrokenDataset, NoDatasetAtAll) {
  const TempFolder folder;
  EXPECT_NE(error_of([&] { read_dataset(folder / "no"); }).find("does not exist"),
            std::string::npos);
  const std::string error = error_of([&] { read_dataset(folder.path().string()); });
  EXPECT_NE(error.find("is no dataset: it holds none of cameras.json"), std::string::npos) << error;
}

}  // namespace
}  // namespace facet_mapping
