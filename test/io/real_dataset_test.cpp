// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shared_data.h"
#include <gtest/gtest.h>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/io/ply.h"

namespace facet_mapping {
namespace {

TEST(RealDataset, KittiDrive) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  ASSERT_EQ(dataset.frames.size(), 51U);
  EXPECT_TRUE(dataset.has_right && dataset.has_scans);
  EXPECT_NEAR(dataset.baseline_m(), 0.54325, 1e-5);
  const View& first = dataset.frames.front().view;
  const View& last = dataset.frames.back().view;
  EXPECT_EQ(first.camera.width, 1242);
  EXPECT_GT(last.center().x(), 40.0);  // forward, about 1.1 m per frame
  EXPECT_LT(std::abs(last.center().z()), 3.0);
  const auto scan = read_scan(dataset.frames[3].scan);
  EXPECT_GT(scan.size(), 10000U);
  EXPECT_EQ(read_labels(dataset.frames[3].labels).size(), cv::Size(1242, 375));
}

TEST(RealDataset, Fountain) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "fountain_p11");
  const Dataset dataset = read_dataset(folder);
  ASSERT_EQ(dataset.frames.size(), 11U);
  for (const DatasetFrame& frame : dataset.frames) {
    EXPECT_EQ(read_gray(frame.left_image).size(), cv::Size(1536, 1024));
    EXPECT_FALSE(frame.gt_depth.empty() || frame.gt_labels.empty() || frame.labels.empty());
  }
  EXPECT_LT(
      (dataset.frames[0].view.center() - Eigen::Vector3d(-7.28137, -7.57667, 0.204446)).norm(),
      1e-4);
  const MeshFile mesh = read_ply(folder + "/start_mesh_coarse.ply");
  EXPECT_EQ(mesh.mesh.triangles.size(), 67048U);
}

}  // namespace
}  // namespace facet_mapping
