// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// COLMAP, MVSNet and DTU folders as they should be.
#include "io/temp_folder.h"
#include "support/view_datasets.h"
#include <gtest/gtest.h>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {
namespace {

using testing::error_of;
using testing::TempFolder;
using testing::three_views;
using testing::write_text;

// Points all over the field of view, between one and a thousand units away.
void expect_same_projections(const Dataset& dataset, const std::vector<View>& views) {
  ASSERT_EQ(dataset.frames.size(), views.size());
  for (std::size_t k = 0; k < views.size(); ++k) {
    const View& read = dataset.frames[k].view;
    EXPECT_EQ(read.camera.width, views[k].camera.width);
    EXPECT_EQ(read.camera.height, views[k].camera.height);
    EXPECT_EQ(dataset.frames[k].stamp, static_cast<double>(k));
    for (const double depth : {1.0, 30.0, 1000.0}) {
      for (const auto& [u, v] : {std::pair(-0.4, 5.3), std::pair(7.2, -0.3), std::pair(3.0, 2.0)}) {
        const Eigen::Vector3d point = depth * views[k].camera.ray({u, v});
        const Eigen::Vector3d in_cam = read.cam_from_world() * (views[k].world_from_cam * point);
        EXPECT_LT((read.camera.project(in_cam) - Eigen::Vector2d(u, v)).norm(), 1e-9) << k;
        EXPECT_NEAR(in_cam.z(), depth, 1e-9 * depth);
      }
    }
  }
}

TEST(ViewLayouts, TheSameCamerasInEveryForm) {
  using Maker = void (*)(const std::string& folder, const std::vector<View>& views);
  const Maker colmap = [](const std::string& folder, const std::vector<View>& views) {
    testing::make_colmap(folder, views);
  };
  for (const Maker make : {static_cast<Maker>(testing::make_strecha),
                           colmap,
                           testing::make_mvsnet,
                           testing::make_dtu}) {
    const TempFolder folder;
    make(folder.path().string(), three_views());
    const Dataset dataset = read_dataset(folder.path().string());
    expect_same_projections(dataset, three_views());
    EXPECT_FALSE(dataset.is_z_up || dataset.has_right || dataset.has_scans);
  }
}

TEST(ViewLayouts, ColmapModelInEachPlace) {
  for (const char* place : {"sparse/0", "sparse", "."}) {
    const TempFolder folder;
    testing::make_colmap(folder.path().string(), three_views(), place);
    expect_same_projections(read_dataset(folder.path().string()), three_views());
  }
}

TEST(ViewLayouts, ColmapTextIsReadWhereBothFormsLie) {
  const TempFolder folder;
  testing::make_colmap(folder.path().string(), three_views());
  write_text(folder / "sparse/0/cameras.bin", "");
  expect_same_projections(read_dataset(folder.path().string()), three_views());
}

TEST(ViewLayouts, ColmapFindsTheOtherImagesInSubfolders) {
  const TempFolder folder;
  testing::make_colmap(folder.path().string(), three_views());
  const cv::Mat image(testing::kHeight, testing::kWidth, CV_8U, cv::Scalar(1));
  testing::write_image(folder / "labels/left/0000.png", image);
  testing::write_image(folder / "labels_gt/left/0001.png", image);
  testing::write_image(folder / "depth_gt/left/0002.png", image);
  Dataset dataset = read_dataset(folder.path().string());
  EXPECT_EQ(dataset.frames[0].left_image, folder / "images/left/0000.png");
  EXPECT_EQ(dataset.frames[0].labels, folder / "labels/left/0000.png");
  EXPECT_EQ(dataset.frames[1].gt_labels, folder / "labels_gt/left/0001.png");
  EXPECT_EQ(dataset.frames[2].gt_depth, folder / "depth_gt/left/0002.png");
  EXPECT_EQ(dataset.frames[0].gt_depth + dataset.frames[1].labels, "");
  EXPECT_EQ(dataset.depth_scale, 2000.0);
  write_text(folder / "depth_gt/scale.txt", "50\n");
  EXPECT_EQ(read_dataset(folder.path().string()).depth_scale, 50.0);
}

// One image of 8x6 pixels at the origin, its camera as given.
PinholeCamera read_colmap_camera(const std::string& row) {
  const TempFolder folder;
  testing::write_image(folder / "images/a b.png", testing::picture(0));
  write_text(folder / "cameras.txt", "# comment\n\n" + row + "\r\n");
  write_text(folder / "images.txt", "1 1 0 0 0 0 0 0 5 a b.png\r\n");
  return read_dataset(folder.path().string()).frames.at(0).view.camera;
}

TEST(ViewLayouts, ColmapModelsWithoutDistortion) {
  for (const char* row : {"5 SIMPLE_PINHOLE 8 6 10 4 3",
                          "5 PINHOLE 8 6 10 10 4 3",
                          "5 SIMPLE_RADIAL 8 6 10 4 3 0",
                          "5 RADIAL 8 6 10 4 3 0 0.0",
                          "5 OPENCV 8 6 10 10 4 3 0 0 0 0",
                          "5 FOV 8 6 10 10 4 3 0",
                          "5 FULL_OPENCV 8 6 10 10 4 3 0 0 0 0 0 0 0 -0"}) {
    const PinholeCamera camera = read_colmap_camera(row);
    EXPECT_EQ(camera.fx, 10.0) << row;
    EXPECT_EQ(camera.fy, 10.0) << row;
    EXPECT_EQ(camera.cx, 3.5) << row;  // the middle of the image in both conventions
    EXPECT_EQ(camera.cy, 2.5) << row;
  }
}

TEST(ViewLayouts, MvsnetOtherFolderNames) {
  const TempFolder folder;
  testing::make_mvsnet(folder.path().string(), three_views());
  std::filesystem::rename(folder / "cams", folder / "cams_1");
  std::filesystem::rename(folder / "images", folder / "blended_images");
  expect_same_projections(read_dataset(folder.path().string()), three_views());
}

// The first projection matrix of the data set, and the parts that MVSNet's camera files hold.
TEST(ViewLayouts, DtuOwnNumbers) {
  const TempFolder folder;
  testing::write_image(folder / "rect_001_3_r5000.png", cv::Mat(1200, 1600, CV_8U, cv::Scalar(0)));
  write_text(folder / "calib/pos_001.txt",
             "2607.429996 -3.844898 1498.178098 -533936.661373\n"
             "-192.076910 2862.552532 681.798177 23434.686572\n"
             "-0.241605 -0.030951 0.969881 22.540121\n");
  const View view = read_dataset(folder.path().string()).frames.at(0).view;
  EXPECT_NEAR(view.camera.fx, 2892.33, 0.01);
  EXPECT_NEAR(view.camera.fy, 2883.18, 0.01);
  EXPECT_NEAR(view.camera.cx, 823.205, 0.01);
  EXPECT_NEAR(view.camera.cy, 619.071, 0.01);
  Eigen::Matrix<double, 3, 4> expected;
  expected << 0.970263, 0.00747983, 0.241939, -191.02, -0.0147429, 0.999493, 0.0282234, 3.28832,
      -0.241605, -0.030951, 0.969881, 22.5401;
  const Eigen::Matrix<double, 3, 4> difference =
      view.cam_from_world().matrix().topRows<3>() - expected;
  EXPECT_LT(difference.leftCols<3>().cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT(difference.col(3).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(ViewLayouts, DtuCalibrationOfTheWholeDownload) {
  const TempFolder folder;
  const std::string scan = folder / "Rectified/scan1";
  testing::make_dtu(scan, three_views());
  std::filesystem::create_directories(folder / "Calibration");
  std::filesystem::rename(scan + "/cal18", folder / "Calibration/cal18");
  expect_same_projections(read_dataset(scan), three_views());
  expect_same_projections(read_dataset(scan + "/"), three_views());
}

TEST(ViewLayouts, DtuTakesOneLightAndThePositionsThatHaveImages) {
  const TempFolder folder;
  testing::make_dtu(folder / "", three_views());
  for (const char* name : {"1_3_r5000", "2_3_r5000", "3_3_r5000", "2_0_r5000"}) {
    std::filesystem::copy(folder / "rect_002_max.png",
                          folder / ("rect_00" + std::string(name) + ".png"));
  }
  EXPECT_EQ(
      std::filesystem::path(read_dataset(folder.path().string()).frames[2].left_image).filename(),
      "rect_003_max.png");
  std::filesystem::remove(folder / "rect_003_max.png");
  std::filesystem::remove(folder / "rect_003_3_r5000.png");
  EXPECT_EQ(read_dataset(folder.path().string()).frames.size(), 2U);
}

TEST(ViewLayouts, DtuImagesInTheirFolderWithLabelsAndDepth) {
  const TempFolder folder;
  testing::make_dtu(folder.path().string(), three_views());
  for (const char* name : {"rect_001_max.png", "rect_002_max.png", "rect_003_max.png"}) {
    std::filesystem::create_directories(folder / "images");
    std::filesystem::rename(folder / name, folder / ("images/" + std::string(name)));
  }
  const cv::Mat image(testing::kHeight, testing::kWidth, CV_8U, cv::Scalar(1));
  testing::write_image(folder / "segmentation/rect_001_max.png", image);
  testing::write_image(folder / "depth_gt/rect_002_max.png", image);
  const std::string error = error_of([&] { read_dataset(folder.path().string()); });
  EXPECT_NE(error.find("depth_gt/scale.txt (one number"), std::string::npos) << error;
  write_text(folder / "depth_gt/scale.txt", "64");
  const Dataset dataset = read_dataset(folder.path().string());
  EXPECT_EQ(dataset.depth_scale, 64.0);
  EXPECT_EQ(dataset.frames[0].labels, folder / "segmentation/rect_001_max.png");
  EXPECT_EQ(dataset.frames[1].gt_depth, folder / "depth_gt/rect_002_max.png");
}

TEST(ViewLayouts, HelpNamesThemAll) {
  const std::string help = dataset_layouts_help();
  for (const char* name : {"Strecha", "KITTI raw", "KITTI odometry", "COLMAP", "MVSNet", "DTU"}) {
    EXPECT_NE(help.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace facet_mapping
