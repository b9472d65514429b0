// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A real scan, labelled from the segmentation of the image taken with it.
#include "support/shared_data.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/points/lidar_points.h"

namespace facet_mapping {
namespace {

TEST(RealLidar, ThinsAndLabelsAScan) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "kitti_drive_0009");
  const Dataset dataset = read_dataset(folder);
  const DatasetFrame& frame = dataset.frames.at(5);
  std::vector<Eigen::Vector3f> scan;
  for (const Eigen::Vector4f& record : read_scan(frame.scan)) {
    scan.emplace_back(record.head<3>());
  }
  const LabelSet classes =
      LabelSet::load(std::string(FACET_MAPPING_SOURCE_DIR) + "/config/labels/cityscapes.yaml");
  const cv::Mat labels =
      decode_label_image(cv::imread(frame.labels, cv::IMREAD_UNCHANGED), "mono8", classes);
  std::vector<LabeledPoint> points = thin_cloud(scan, {});
  EXPECT_GT(points.size(), 5000U);
  EXPECT_LT(points.size(), 12000U);
  ImageLabelConfig config;
  config.excluded_labels = {10};
  label_points_from_image(points, dataset.left_from_velo, frame.view.camera, labels, config);

  // The sensor is 1.73 m above the road: what lies lower is road or what stands on it.
  std::size_t low = 0;
  std::size_t low_ground = 0;
  for (const LabeledPoint& point : points) {
    EXPECT_NE(point.label, 10);
    if (point.position.z() < -1.6F && point.label != kUnlabelled) {
      ++low;
      const std::string name = classes.name_of(point.label);
      low_ground += name == "road" || name == "sidewalk" || name == "terrain" ? 1 : 0;
    }
  }
  EXPECT_GT(low, 1000U);
  EXPECT_GT(10 * low_ground, 8 * low);
}

}  // namespace
}  // namespace facet_mapping
