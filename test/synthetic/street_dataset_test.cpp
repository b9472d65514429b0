// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_dataset.h"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "io/temp_folder.h"
#include "synthetic/test_street.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/io/ply.h"

namespace facet_mapping {
namespace {

using testing::TempFolder;

Street three_frames() {
  StreetConfig config;
  config.length_m = 20.0;
  config.frames = 3;
  config.tree_spacing_m = 8.0;
  return make_street(config);
}

StreetDatasetConfig quick() {
  StreetDatasetConfig config;
  config.view.supersampling = 1;
  config.lidar.beams = 8;
  return config;
}

std::map<std::string, std::string> contents(const TempFolder& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    if (entry.is_regular_file()) {
      files[std::filesystem::relative(entry.path(), folder.path()).string()] =
          testing::read_text(entry.path().string());
    }
  }
  return files;
}

TEST(StreetDataset, ReadsBackAsWritten) {
  const Street street = three_frames();
  TempFolder folder;
  std::size_t done = 0;
  write_street_dataset(
      street, quick(), folder.path().string(), [&](std::size_t d, std::size_t total) {
        EXPECT_EQ(d, ++done);
        EXPECT_EQ(total, 3U);
      });
  EXPECT_EQ(done, 3U);
  const Dataset dataset = read_dataset(folder.path().string());
  ASSERT_EQ(dataset.frames.size(), 3U);
  EXPECT_TRUE(dataset.has_right);
  EXPECT_TRUE(dataset.has_scans);
  EXPECT_NEAR(dataset.baseline_m(), kitti_rig(false).baseline_m, 1e-12);
  for (std::size_t k = 0; k < 3; ++k) {
    const DatasetFrame& frame = dataset.frames[k];
    // The reader's map frame is the generator's.
    EXPECT_TRUE(frame.view.world_from_cam.isApprox(street.trajectory[k].map_from_left, 1e-9));
    EXPECT_NEAR(frame.view.camera.fx, kitti_rig(false).camera.fx, 1e-9);
    EXPECT_NEAR(frame.view.camera.cy, kitti_rig(false).camera.cy, 1e-9);
    EXPECT_NEAR(frame.stamp, 0.1 * static_cast<double>(k), 1e-6);
    EXPECT_FALSE(read_scan(frame.scan).empty());
  }
}

TEST(StreetDataset, DepthAndLabelsAreTheRenderersOwn) {
  const Street street = three_frames();
  TempFolder folder;
  write_street_dataset(street, quick(), folder.path().string());
  const Dataset dataset = read_dataset(folder.path().string());
  const StreetRenderer renderer(street, quick().view);
  const StreetImage image = renderer.render(dataset.frames[1].view, {});
  const cv::Mat depth = read_depth(dataset.frames[1].gt_depth, dataset.depth_scale);
  EXPECT_LE(cv::norm(depth, image.depth, cv::NORM_INF), 0.5 / 256.0 + 1e-6);
  const cv::Mat labels = cv::imread(dataset.frames[1].gt_labels, cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(labels, image.labels, cv::NORM_INF), 0.0);
}

TEST(StreetDataset, GroundTruthMeshIsTheStreet) {
  const Street street = three_frames();
  TempFolder folder;
  StreetDatasetConfig config = quick();
  config.scans = false;
  write_street_dataset(street, config, folder.path().string());
  const MeshFile file = read_ply(folder / "ground_truth.ply");
  EXPECT_EQ(file.frame_id, "map");
  EXPECT_EQ(file.mesh.triangles, street.mesh.triangles);
  EXPECT_EQ(file.mesh.labels, street.mesh.labels);
  EXPECT_EQ(file.labels.name_of(street_class::kCar), "car");
  EXPECT_FALSE(read_dataset(folder.path().string()).has_scans);
}

TEST(StreetDataset, SameSeedSameBytes) {
  const Street street = three_frames();
  TempFolder a;
  TempFolder b;
  TempFolder c;
  StreetDatasetConfig config = quick();
  write_street_dataset(street, config, a.path().string());
  write_street_dataset(three_frames(), config, b.path().string());
  EXPECT_EQ(contents(a), contents(b));
  config.seed = 2;
  write_street_dataset(street, config, c.path().string());
  EXPECT_NE(contents(a).at("left/000001.png"), contents(c).at("left/000001.png"));
  EXPECT_NE(contents(a).at("labels/000001.png"), contents(c).at("labels/000001.png"));
  EXPECT_EQ(contents(a).at("gt_label/000001.png"), contents(c).at("gt_label/000001.png"));
}

TEST(StreetDataset, WithoutNoiseTheLabelsAreExact) {
  TempFolder folder;
  StreetDatasetConfig config = quick();
  config.label_noise = 0.0;
  write_street_dataset(three_frames(), config, folder.path().string());
  const auto files = contents(folder);
  EXPECT_EQ(files.at("labels/000002.png"), files.at("gt_label/000002.png"));
}

TEST(StreetDataset, RefusesToMixWithALongerDataset) {
  TempFolder folder;
  testing::write_text(folder / "left/000003.png", "older");
  EXPECT_THROW(write_street_dataset(three_frames(), quick(), folder.path().string()),
               std::runtime_error);
}

TEST(StreetDataset, SaysWhereItCannotWrite) {
  TempFolder folder;
  testing::write_text(folder / "file", "in the way");
  const std::string error =
      testing::error_of([&] { write_street_dataset(three_frames(), quick(), folder / "file"); });
  EXPECT_NE(error.find("file"), std::string::npos);
  StreetDatasetConfig config = quick();
  config.label_noise = -1.0;
  EXPECT_THROW(write_street_dataset(three_frames(), config, folder.path().string()),
               std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
