// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/dataset_points.h"

#include <filesystem>
#include <stdexcept>

#include "support/shared_data.h"
#include "support/small_datasets.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

LabelSet three_classes() {
  std::vector<ClassInfo> classes(3);
  for (int k = 0; k < 3; ++k) {
    classes[k].id = static_cast<Label>(k);
    classes[k].name = "class " + std::to_string(k);
    classes[k].color = {static_cast<std::uint8_t>(k), 0, 0};
  }
  classes[2].sky = true;
  return LabelSet(classes);
}

DatasetPointsConfig every_scan_point() {
  DatasetPointsConfig config;
  config.stereo = false;
  config.lidar = true;
  config.cloud_config.outlier_radius_m = 0.0;
  config.cloud_config.voxel_m = 0.0;
  return config;
}

TEST(DatasetPoints, ScansTakeTheirClassFromTheSegmentation) {
  const testing::TempFolder folder;
  testing::make_plain(folder.path());
  const Dataset dataset = read_dataset(folder.path());
  const DatasetPoints points(dataset, three_classes(), every_scan_point());
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<SensorPoints> sensors = points.read(k);
    ASSERT_EQ(sensors.size(), 1U);
    EXPECT_EQ(sensors[0].sensor, "lidar");
    ASSERT_EQ(sensors[0].frame.points.size(), 2U);
    EXPECT_EQ(sensors[0].frame.stamp, dataset.frames[k].stamp);
    // The first point lies 4.7 m in front of the left camera and 0.1 m above its axis.
    const Eigen::Vector3d in_left =
        dataset.frames[k].view.cam_from_world() *
        (sensors[0].frame.world_from_sensor * sensors[0].frame.points[0].position.cast<double>());
    EXPECT_LT((in_left - Eigen::Vector3d(0.0, -0.1, 4.7)).norm(), 1e-6);
    // Class 2 is sky: no LiDAR return is of it.
    EXPECT_EQ(sensors[0].frame.points[0].label, k == 2 ? kUnlabelled : static_cast<Label>(k));
  }
}

TEST(DatasetPoints, WithoutClassesOrLabelImagesPointsHaveNone) {
  const testing::TempFolder folder;
  testing::make_plain(folder.path());
  const Dataset all = read_dataset(folder.path());
  EXPECT_EQ(DatasetPoints(all, LabelSet(), every_scan_point()).read(1)[0].frame.points[0].label,
            kUnlabelled);
  std::filesystem::remove_all(folder / "labels");
  const Dataset without = read_dataset(folder.path());
  EXPECT_EQ(
      DatasetPoints(without, three_classes(), every_scan_point()).read(1)[0].frame.points[0].label,
      kUnlabelled);
}

TEST(DatasetPoints, SaysWhatIsMissing) {
  const testing::TempFolder folder;
  testing::make_plain(folder.path());
  std::filesystem::remove_all(folder / "right");
  std::filesystem::remove_all(folder / "velodyne");
  const Dataset dataset = read_dataset(folder.path());
  DatasetPointsConfig config;
  EXPECT_THROW(DatasetPoints(dataset, {}, config), std::invalid_argument);
  EXPECT_THROW(DatasetPoints(dataset, {}, every_scan_point()), std::invalid_argument);
  config.stereo = false;
  EXPECT_THROW(DatasetPoints(dataset, {}, config), std::invalid_argument);
}

/// The first frames of the dataset, each once.
void expect_frames_in_order(const std::vector<SensorPoints>& points,
                            const std::string& sensor,
                            std::size_t count,
                            const Dataset& dataset) {
  ASSERT_EQ(points.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_EQ(points[k].sensor, sensor);
    EXPECT_EQ(points[k].frame.stamp, dataset.frames[k].stamp);
    EXPECT_GT(points[k].frame.points.size(), 100U);
  }
}

TEST(DatasetPoints, TracksOfARealDriveComeOutForEveryFrameOnceAndInOrder) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  DatasetPointsConfig config;
  config.stereo = false;
  config.tracks = true;
  config.track_config.window = 2;
  DatasetPoints points(dataset, {}, config);
  std::vector<SensorPoints> all;
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_TRUE(points.read(k).empty());
    TrackReport report;
    const std::vector<SensorPoints> done = points.follow(k, &report);
    EXPECT_TRUE(report.used);
    all.insert(all.end(), done.begin(), done.end());
  }
  EXPECT_EQ(all.size(), 3U);
  const std::vector<SensorPoints> rest = points.finish();
  all.insert(all.end(), rest.begin(), rest.end());
  expect_frames_in_order(all, "tracks", 5U, dataset);
}

TEST(DatasetPoints, SweptPointsOfARealDriveComeOutForEveryFrameOnceAndInOrder) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  DatasetPointsConfig config;
  config.stereo = false;
  config.sweep = true;
  config.sweep_config.sweep_width_px = 400;
  DatasetPoints points(dataset, {}, config);
  std::vector<SensorPoints> all;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<SensorPoints> done = points.follow(k);
    all.insert(all.end(), done.begin(), done.end());
  }
  const std::vector<SensorPoints> rest = points.finish();
  EXPECT_FALSE(rest.empty());
  all.insert(all.end(), rest.begin(), rest.end());
  expect_frames_in_order(all, "sweep", 4U, dataset);
}

TEST(DatasetPoints, FollowGivesNothingUnlessTracksAreWanted) {
  const testing::TempFolder folder;
  testing::make_plain(folder.path());
  const Dataset dataset = read_dataset(folder.path());
  DatasetPoints points(dataset, three_classes(), every_scan_point());
  EXPECT_TRUE(points.follow(0).empty());
  EXPECT_TRUE(points.finish().empty());
}

TEST(DatasetPoints, BothSourcesOfARealFrameLieInTheSameStreet) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  DatasetPointsConfig config;
  config.lidar = true;
  const std::vector<SensorPoints> sensors = DatasetPoints(dataset, {}, config).read(10);
  ASSERT_EQ(sensors.size(), 2U);
  for (const SensorPoints& sensor : sensors) {
    EXPECT_GT(sensor.frame.points.size(), 3000U) << sensor.sensor;
    // Road: about 1.65 m below the camera, straight ahead.
    std::size_t road = 0;
    for (const LabeledPoint& point : sensor.frame.points) {
      const Eigen::Vector3d in_left =
          dataset.frames[10].view.cam_from_world() *
          (sensor.frame.world_from_sensor * point.position.cast<double>());
      const bool ahead = std::abs(in_left.x()) < 1.0 && in_left.z() > 5.0 && in_left.z() < 15.0;
      road += ahead && std::abs(in_left.y() - 1.65) < 0.2 ? 1 : 0;
    }
    EXPECT_GT(road, 50U) << sensor.sensor;
  }
}

}  // namespace
}  // namespace facet_mapping
