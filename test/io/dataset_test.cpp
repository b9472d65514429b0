// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The layouts as they should be.
#include "facet_mapping/io/dataset.h"

#include <limits>
#include <stdexcept>

#include "io/temp_folder.h"
#include "support/small_datasets.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using testing::TempFolder;

Eigen::Matrix3d map_from_optical() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return rotation;
}

void expect_driving_forward(const Dataset& dataset) {
  ASSERT_EQ(dataset.frames.size(), 3U);
  EXPECT_TRUE(dataset.is_z_up);
  for (std::size_t k = 0; k < 3; ++k) {
    const View& view = dataset.frames[k].view;
    EXPECT_TRUE(view.center().isApprox(Eigen::Vector3d(static_cast<double>(k), 0, 0), 1e-6) ||
                k == 0)
        << view.center().transpose();
    EXPECT_LT((view.world_from_cam.linear() - map_from_optical()).norm(), 1e-6);
    EXPECT_EQ(view.camera.width, testing::kWidth);
    EXPECT_EQ(view.camera.height, testing::kHeight);
    EXPECT_EQ(view.camera.fx, 10.0);
    EXPECT_EQ(view.camera.cy, 3.0);
  }
  EXPECT_LT(dataset.frames[0].view.center().norm(), 1e-9);
  EXPECT_NEAR(dataset.baseline_m(), 0.5, 1e-12);
  EXPECT_TRUE(dataset.has_right);
  EXPECT_TRUE(dataset.has_scans);
}

TEST(Dataset, PlainLayout) {
  const TempFolder folder;
  testing::make_plain(folder.path().string());
  const Dataset dataset = read_dataset(folder.path().string());
  expect_driving_forward(dataset);
  const DatasetFrame& frame = dataset.frames[2];
  EXPECT_EQ(frame.stamp, 0.2);
  EXPECT_EQ(frame.left_image, folder / "left/000002.png");
  EXPECT_EQ(frame.right_image, folder / "right/000002.png");
  EXPECT_EQ(frame.labels, folder / "labels/000002.png");
  EXPECT_EQ(frame.gt_labels, folder / "gt_label/000002.png");
  EXPECT_EQ(frame.gt_depth, folder / "gt_depth/000002.png");
  EXPECT_EQ(frame.scan, folder / "velodyne/000002.bin");
  EXPECT_EQ(dataset.right_from_left.translation(), Eigen::Vector3d(-0.5, 0.01, 0.02));
  const Eigen::Vector3d ahead = dataset.left_from_velo * Eigen::Vector3d(5, 0, 0);
  EXPECT_LT((ahead - Eigen::Vector3d(0, -0.1, 4.7)).norm(), 1e-9);
  EXPECT_EQ(dataset.depth_scale, 256.0);
}

TEST(Dataset, PlainLayoutNeedsOnlyTheLeftImages) {
  const TempFolder folder;
  testing::make_plain(folder.path().string());
  for (const char* name : {"right", "labels", "gt_label", "gt_depth", "velodyne"}) {
    std::filesystem::remove_all(folder / name);
  }
  testing::write_text(folder / "calib.txt", "K: 10 0 4 0 10 3 0 0 1\n");
  const Dataset dataset = read_dataset(folder.path().string());
  EXPECT_FALSE(dataset.has_right);
  EXPECT_FALSE(dataset.has_scans);
  EXPECT_EQ(dataset.frames[1].right_image + dataset.frames[1].labels + dataset.frames[1].scan, "");
}

TEST(Dataset, KittiOdometryWithPosesInTheFolder) {
  const TempFolder folder;
  testing::make_odometry(folder.path().string());
  const Dataset dataset = read_dataset(folder.path().string());
  expect_driving_forward(dataset);
  EXPECT_EQ(dataset.frames[1].left_image, folder / "image_2/000001.png");
  EXPECT_EQ(dataset.frames[1].right_image, folder / "image_3/000001.png");
  // Camera 2 has x = -0.06 in camera 0, so points of the scan lie 0.06 m further right in it.
  const Eigen::Vector3d ahead = dataset.left_from_velo * Eigen::Vector3d(5, 0, 0);
  EXPECT_LT((ahead - Eigen::Vector3d(0.06, -0.1, 4.7)).norm(), 1e-9);
}

TEST(Dataset, KittiOdometryMovesTurningPosesToTheImagesCamera) {
  const TempFolder folder;
  testing::make_odometry(folder.path().string());
  // Frame 1: camera 0 stays and turns 90 degrees to the left (its z axis points along -x).
  testing::write_text(
      folder / "poses.txt",
      "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 -1 0 0 1 0 0 1 0 0 0\n1 0 0 0 0 1 0 0 0 0 1 2\n");
  const Dataset dataset = read_dataset(folder.path().string());
  // Camera 2 stood 0.06 m left of camera 0 and stands 0.06 m behind it after the turn (z = -0.06):
  // from where it was that is 0.06 m right and 0.06 m back; map: x forward, y left.
  EXPECT_LT((dataset.frames[1].view.center() - Eigen::Vector3d(-0.06, -0.06, 0)).norm(), 1e-9);
}

TEST(Dataset, KittiOdometryWithPosesBesideTheSequences) {
  const TempFolder folder;
  testing::make_odometry(folder / "sequences/07");
  std::filesystem::create_directories(folder / "poses");
  std::filesystem::rename(folder / "sequences/07/poses.txt", folder / "poses/07.txt");
  expect_driving_forward(read_dataset(folder / "sequences/07"));
  expect_driving_forward(read_dataset(folder / "sequences/07/"));
}

TEST(Dataset, KittiOdometryGreyCameras) {
  const TempFolder folder;
  testing::make_odometry(folder.path().string());
  std::filesystem::rename(folder / "image_2", folder / "image_0");
  std::filesystem::rename(folder / "image_3", folder / "image_1");
  const Dataset dataset = read_dataset(folder.path().string());
  expect_driving_forward(dataset);
  EXPECT_EQ(dataset.frames[0].left_image, folder / "image_0/000000.png");
}

TEST(Dataset, KittiRaw) {
  const TempFolder folder;
  const std::string drive = testing::make_raw(folder / "2011_09_26");
  const Dataset dataset = read_dataset(drive);
  expect_driving_forward(dataset);
  EXPECT_EQ(dataset.frames[2].labels, drive + "/labels/0000000002.png");
  EXPECT_EQ(dataset.frames[0].scan, "");  // the drive lacks this scan, as real ones do
  EXPECT_EQ(dataset.frames[1].scan, drive + "/velodyne_points/data/0000000001.bin");
  EXPECT_DOUBLE_EQ(dataset.frames[2].stamp, 2.0);
  EXPECT_DOUBLE_EQ(dataset.epoch, 1317042145.5);  // 2011-09-26 13:02:25.5 UTC
}

TEST(Dataset, KittiRawClimbsUpwards) {
  const TempFolder folder;
  const std::string drive = testing::make_raw(folder / "day");
  std::string packet = testing::read_text(drive + "/oxts/data/0000000002.txt");
  packet.replace(packet.find("110.0"), 5, "112.5");
  testing::write_text(drive + "/oxts/data/0000000002.txt", packet);
  EXPECT_NEAR(read_dataset(drive).frames[2].view.center().z(), 2.5, 1e-6);
}

TEST(Dataset, EndFrame) {
  Dataset dataset;
  dataset.frames.resize(3);
  EXPECT_EQ(end_frame(dataset, 0, 1), 2U);
  EXPECT_EQ(end_frame(dataset, 2, 2), 3U);
  EXPECT_EQ(end_frame(dataset, 1, std::numeric_limits<std::size_t>::max()), 3U);
  EXPECT_THROW(end_frame(dataset, 3, 5), std::invalid_argument);
  EXPECT_THROW(end_frame(dataset, 2, 1), std::invalid_argument);
  EXPECT_THROW(end_frame(Dataset(), 0, 0), std::invalid_argument);
}

TEST(Dataset, Strecha) {
  const TempFolder folder;
  testing::make_strecha(folder.path().string());
  const Dataset dataset = read_dataset(folder.path().string());
  ASSERT_EQ(dataset.frames.size(), 2U);
  const DatasetFrame& frame = dataset.frames[1];
  // x_cam = R x + t, so the centre is -R^T t.
  EXPECT_LT((frame.view.center() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_EQ(frame.view.camera.fy, 11.0);
  EXPECT_EQ(frame.gt_depth, folder / "depth_gt/0001.png");
  EXPECT_EQ(dataset.frames[0].gt_depth, "");
  EXPECT_EQ(dataset.depth_scale, 2000.0);
  EXPECT_FALSE(dataset.is_z_up);
  EXPECT_FALSE(dataset.has_right);
}

}  // namespace
}  // namespace facet_mapping
