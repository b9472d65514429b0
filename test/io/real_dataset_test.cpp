// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shared_data.h"
#include "support/view_datasets.h"
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

TEST(RealDataset, FountainAsColmapModel) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "fountain_p11");
  const Dataset strecha = read_dataset(folder);
  const testing::TempFolder other;
  std::filesystem::create_directories(other / "sparse");
  std::vector<View> views;
  std::vector<std::string> names;
  for (const DatasetFrame& frame : strecha.frames) {
    views.push_back(frame.view);
    names.push_back(std::filesystem::path(frame.left_image).filename().string());
  }
  testing::write_colmap_model(other / "sparse/0", views, names);
  for (const char* part : {"images", "segmentation", "labels_gt", "depth_gt"}) {
    std::filesystem::create_directory_symlink(std::filesystem::absolute(folder + "/" + part),
                                              other / part);
  }
  const Dataset colmap = read_dataset(other.path().string());
  ASSERT_EQ(colmap.frames.size(), strecha.frames.size());
  EXPECT_EQ(colmap.depth_scale, strecha.depth_scale);
  for (std::size_t k = 0; k < colmap.frames.size(); ++k) {
    const DatasetFrame& frame = colmap.frames[k];
    const View& view = frame.view;
    EXPECT_LT((view.world_from_cam.matrix() - views[k].world_from_cam.matrix()).norm(), 1e-12);
    EXPECT_NEAR(view.camera.cx, views[k].camera.cx, 1e-12);
    EXPECT_EQ(view.camera.fy, views[k].camera.fy);
    EXPECT_FALSE(frame.gt_depth.empty() || frame.gt_labels.empty() || frame.labels.empty());
  }
}

}  // namespace
}  // namespace facet_mapping
