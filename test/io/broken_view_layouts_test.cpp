// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a COLMAP, MVSNet or DTU folder is named.
#include "support/damaged_dataset.h"
#include "support/view_datasets.h"

namespace facet_mapping {
namespace {

using testing::check;
using testing::Damage;
using testing::Maker;
using testing::remove_file;
using testing::replace;
using testing::write_file;

Damage both(const Damage& first, const Damage& second) {
  return [=](const std::string& folder) {
    first(folder);
    second(folder);
  };
}

std::string make_colmap(const std::string& folder) {
  testing::make_colmap(folder, testing::three_views());
  return folder;
}

TEST(BrokenViewLayouts, ColmapCameras) {
  const std::string path = "sparse/0/cameras.txt";
  const std::string undistort = "run 'colmap image_undistorter' first";
  const auto camera_12 = [&](const std::string& row) {
    return both(replace(path, "12 PINHOLE", "# "),
                replace(path, "11 PINHOLE", "12 " + row + "\n11 PINHOLE"));
  };
  check(make_colmap,
        {{remove_file(path), {"missing: ", "/sparse/0/cameras.txt", "(1 problem)"}},
         {write_file(path, "# nothing\n"), {"cameras.txt holds no cameras", "(1 problem)"}},
         {replace(path, "12 PINHOLE", "13 PINHOLE"),
          {"the image 'left/0002.png' has the camera id 12, which cameras.txt does not know"}},
         {replace(path, "12 PINHOLE", "11 PINHOLE"), {"gives the camera id 11 again"}},
         {replace(path, "PINHOLE 12 6", "PINHOLE 12 nan"), {"line 3 holds NaN or infinity"}},
         {replace(path, "PINHOLE 12 6", "PINHOLE 12"), {"line 3 holds 5 numbers instead of 6"}},
         {replace(path, "PINHOLE 12 6", "PINHOLE -12 6"), {"line 3: size and focal lengths"}},
         {replace(path, "PINHOLE 12 6", "PINHOLE 1e30 6"), {"line 3: size and focal lengths"}},
         {replace(path, "PINHOLE 12 6", "PINHOLE 24 12"),
          {"left/0002.png has 12x6 pixels, but its camera in cameras.txt 24x12"}},
         {camera_12("SIMPLE_RADIAL 12 6 10 6 3 0.01"),
          {"line 4 is a camera with distortion (SIMPLE_RADIAL)", undistort, "(1 problem)"}},
         {camera_12("OPENCV 12 6 10 10 6 3 0 0 0 1e-9"), {"distortion (OPENCV)", undistort}},
         {camera_12("OPENCV_FISHEYE 12 6 10 10 6 3 0 0 0 0"), {"(OPENCV_FISHEYE)", undistort}},
         {camera_12("OPENCV 12 6 10 10 6 3 0 0"), {"line 4 holds 8 numbers instead of 10"}},
         {camera_12("MIRROR 12 6 10 6 3"), {"camera model 'MIRROR'", undistort}}});
}

TEST(BrokenViewLayouts, ColmapImages) {
  const std::string path = "sparse/0/images.txt";
  const std::string row = "1 1 0 0 0 0 0 0 10 left/0000.png\n";
  const std::string points = "2362.39 248.498 58396 1784.7 268.254 -1\n";
  check(
      make_colmap,
      {{remove_file(path), {"missing: ", "/sparse/0/images.txt", "(1 problem)"}},
       {write_file(path, "# nothing\n"), {"images.txt holds no images"}},
       {write_file(path, row), {}},
       {write_file(path, row + "\n" + row), {"has the image 'left/0000.png' twice"}},
       {write_file(path, row + row), {"line 2 must hold the 2D points of the image above"}},
       {write_file(path, "# Number of images: 2, mean\n" + row),
        {"says that it has 2 images, but holds 1"}},
       {write_file(path, "1 1 0 0 0 0 0\n"), {"line 1 is no row 'IMAGE_ID QW", "cut off?"}},
       {write_file(path, "1 1 0 0 0 0 0 0 10\n"), {"line 1 is no row 'IMAGE_ID QW"}},
       {write_file(path, "1 1 0 0 0 nan 0 0 10 left/0000.png\n"), {"line 1 holds NaN"}},
       {write_file(path, "1 1 0 0 0 x 0 0 10 left/0000.png\n"), {"line 1 holds a word"}},
       {write_file(path, "1 2 0 0 0 0 0 0 10 left/0000.png\n"),
        {"line 1 has a quaternion QW QX QY QZ whose length is not 1"}},
       {replace(path, points, ""), {"line 4 must hold the 2D points of the image above"}},
       {remove_file("images"), {"missing: ", "/images (the folder", "(1 problem)"}},
       {remove_file("images/left/0001.png"), {"missing: ", "/images/left/0001.png", "(1 problem)"}},
       {write_file("images/left/0001.png", "no image"), {"left/0001.png' is truncated"}}});
}

TEST(BrokenViewLayouts, ColmapBinary) {
  check(make_colmap,
        {{both(remove_file("sparse/0/images.txt"),
               both(remove_file("sparse/0/cameras.txt"), write_file("sparse/0/cameras.bin", "x"))),
          {"sparse/0 is binary; run 'colmap model_converter", "--output_type TXT'"}}});
}

TEST(BrokenViewLayouts, Mvsnet) {
  const Maker make = [](const std::string& folder) {
    testing::make_mvsnet(folder, testing::three_views());
    return folder;
  };
  const std::string path = "cams/00000001_cam.txt";
  const std::string pose = "extrinsic\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  const std::string camera = "intrinsic\n10 0 4.5\n0 10 3\n0 0 1\n";
  check(make,
        {{write_file(path, pose + camera), {}},  // the depth range is not needed
         {write_file(path, ""), {"_cam.txt has no line 'extrinsic'", "no line 'intrinsic'"}},
         {write_file(path, pose), {"has no line 'intrinsic'", "(1 problem)"}},
         {write_file(path, pose + "intrinsic\n10 0 4.5\n0 10"),
          {"'intrinsic' holds 5 numbers instead of 9"}},
         {write_file(path, pose + "intrinsic\n10 0.2 4.5\n0 10 3\n0 0 1\n"), {"has a skew of 0.2"}},
         {write_file(path, pose + "intrinsic\n10 0 4.5\n0 -10 3\n0 0 1\n"), {"positive focal"}},
         {write_file(path, pose + "intrinsic\n10 0 4.5\n0 10 3\n0 0 2\n"), {"0 0 1 with"}},
         {write_file(path, pose + "intrinsic\n2.5 0 1.1\n0 2.5 0.7\n0 0 1\n"),
          {"principal point 1.1 0.7 lies far from the centre", "10x6 pixels"}},
         {write_file(path, "extrinsic\n1 0 0 0\n0 1 0 0\n0 0 1 nan\n0 0 0 1\n" + camera),
          {"'extrinsic' holds NaN"}},
         {write_file(path, "extrinsic\n1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n" + camera),
          {"'extrinsic' is no rigid transform"}},
         {write_file(path, "extrinsic\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 1 0\n" + camera),
          {"'extrinsic' is no rigid transform"}},
         {remove_file(path), {"missing: ", "/00000001_cam.txt (its image is there)"}},
         {remove_file("images"), {"missing: ", "/images (the folder", "(1 problem)"}},
         {remove_file("images/00000002.jpg"), {"missing: ", "/images/00000002.jpg"}},
         {write_file("images/00000002.jpg", ""), {"00000002.jpg' is truncated"}}});
}

TEST(BrokenViewLayouts, Dtu) {
  const Maker make = [](const std::string& folder) {
    testing::make_dtu(folder, testing::three_views());
    return folder;
  };
  const std::string path = "cal18/pos_002.txt";
  check(make,
        {{remove_file("cal18"), {"missing: ", "/cal18/pos_001.txt ... (projection matrices"}},
         {remove_file(path), {"missing: ", "/cal18/pos_002.txt", "(1 problem)"}},
         {write_file(path, ""), {"pos_002.txt is empty", "(1 problem)"}},
         {write_file(path, "10 0 4.5 0\n0 10 3 0\n"), {"holds 2 rows instead of the 3"}},
         {write_file(path, "10 0 4.5 0\n0 10 3 0\n0 0 1"), {"line 3 holds 3 numbers instead of 4"}},
         {write_file(path, "10 0 4.5 0\n0 inf 3 0\n0 0 1 0"), {"line 2 holds NaN or infinity"}},
         {write_file(path, "10 0 4.5 0\n20 0 9 0\n0 0 1 0"), {"is no projection matrix"}},
         {write_file(path, "10 3 4.5 0\n0 10 3 0\n0 0 1 0"), {"has a skew of 3.0"}},
         {write_file(path, "10 0 20 0\n0 10 15 0\n0 0 1 0"), {"principal point 20 15 lies far"}},
         {write_file("rect_001_max.png", "no image"), {"rect_001_max.png' is truncated"}},
         {[](const std::string& folder) {
            std::filesystem::rename(folder + "/rect_002_max.png", folder + "/rect_002_3_r5000.png");
          },
          {"missing: ", "/rect_002_max.png (all views are taken under the same light)"}}});
}

}  // namespace
}  // namespace facet_mapping
