// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/cloud_conversions.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

namespace facet_mapping {
namespace {

using sensor_msgs::PointField;

/// One point (1, 2, 3) whose label field has the given type and bytes.
template <typename T>
sensor_msgs::PointCloud2 cloud_with_label(std::uint8_t datatype, T label) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(4,
                                "x",
                                1,
                                PointField::FLOAT32,
                                "y",
                                1,
                                PointField::FLOAT32,
                                "z",
                                1,
                                PointField::FLOAT32,
                                "label",
                                1,
                                datatype);
  modifier.resize(1);
  const float position[3] = {1.0F, 2.0F, 3.0F};
  std::memcpy(cloud.data.data(), position, sizeof(position));
  std::memcpy(cloud.data.data() + cloud.fields[3].offset, &label, sizeof(T));
  return cloud;
}

template <typename T>
Label label_read(std::uint8_t datatype, T label) {
  return points_from_cloud(cloud_with_label(datatype, label)).at(0).label;
}

TEST(Cloud, PointsSurviveTheRoundTrip) {
  std::vector<LabeledPoint> points(3);
  points[0] = {{1.0F, -2.0F, 3.5F}, 7, 0.25F};
  points[1] = {{NAN, 0.0F, 0.0F}, kUnlabelled, 0.0F};
  points[2] = {{0.0F, 0.0F, 40.0F}, 65534, 1.0F};
  std_msgs::Header header;
  header.frame_id = "camera";
  const sensor_msgs::PointCloud2 cloud = cloud_from_points(points, header);
  EXPECT_EQ(cloud.header.frame_id, "camera");
  const std::vector<LabeledPoint> back = points_from_cloud(cloud);
  ASSERT_EQ(back.size(), 3U);
  EXPECT_EQ(back[0].position, points[0].position);
  EXPECT_EQ(back[0].label, 7);
  EXPECT_EQ(back[0].sigma, 0.25F);
  EXPECT_TRUE(std::isnan(back[1].position.x()));
  EXPECT_EQ(back[2].label, 65534);
}

TEST(Cloud, LabelsOfEveryTypeAreRead) {
  EXPECT_EQ(label_read<std::uint8_t>(PointField::UINT8, 200), 200);
  EXPECT_EQ(label_read<std::uint16_t>(PointField::UINT16, 300), 300);
  EXPECT_EQ(label_read<std::int32_t>(PointField::INT32, 300), 300);
  EXPECT_EQ(label_read<std::uint32_t>(PointField::UINT32, 300), 300);
  EXPECT_EQ(label_read<float>(PointField::FLOAT32, 11.0F), 11);
  EXPECT_EQ(label_read<double>(PointField::FLOAT64, 11.0), 11);
}

TEST(Cloud, WhatIsNoIdIsUnlabelled) {
  EXPECT_EQ(label_read<std::int32_t>(PointField::INT32, -1), kUnlabelled);
  EXPECT_EQ(label_read<std::uint32_t>(PointField::UINT32, 70000), kUnlabelled);
  EXPECT_EQ(label_read<float>(PointField::FLOAT32, NAN), kUnlabelled);
}

TEST(Cloud, WithoutLabelEverythingIsUnlabelled) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(2);
  EXPECT_EQ(points_from_cloud(cloud).at(1).label, kUnlabelled);
}

TEST(Cloud, RowsWithPaddingAreRead) {
  sensor_msgs::PointCloud2 cloud = cloud_with_label<std::uint8_t>(PointField::UINT8, 5);
  cloud.height = 2;
  cloud.row_step = cloud.point_step + 8;
  const std::vector<std::uint8_t> row = cloud.data;
  cloud.data.resize(2 * cloud.row_step);
  std::copy(row.begin(), row.end(), cloud.data.begin() + cloud.row_step);
  const std::vector<LabeledPoint> points = points_from_cloud(cloud);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].position, Eigen::Vector3f(1.0F, 2.0F, 3.0F));
}

TEST(Cloud, MissingCoordinateIsRefused) {
  sensor_msgs::PointCloud2 cloud = cloud_with_label<std::uint8_t>(PointField::UINT8, 5);
  cloud.fields[2].name = "depth";
  EXPECT_THROW(points_from_cloud(cloud), std::invalid_argument);
  cloud.fields.clear();
  EXPECT_THROW(points_from_cloud(cloud), std::invalid_argument);
}

TEST(Cloud, TruncatedBufferIsRefused) {
  sensor_msgs::PointCloud2 cloud = cloud_with_label<std::uint8_t>(PointField::UINT8, 5);
  cloud.width = 2;
  EXPECT_THROW(points_from_cloud(cloud), std::invalid_argument);
  cloud.row_step = 2 * cloud.point_step;
  EXPECT_THROW(points_from_cloud(cloud), std::invalid_argument);
  cloud.width = 1;
  cloud.fields[0].offset = 1000;
  EXPECT_THROW(points_from_cloud(cloud), std::invalid_argument);
}

TEST(Cloud, MeshFacetsBecomeColouredPoints) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.labels = {4};
  const LabelSet labels({{4, "tree", {1, 2, 3}}});
  const auto cloud = cloud_from_mesh(mesh, labels, std_msgs::Header());
  EXPECT_EQ(points_from_cloud(cloud).at(0).position, Eigen::Vector3f(1.0F, 1.0F, 0.0F));
  EXPECT_EQ(points_from_cloud(cloud).at(0).label, 4);
  const sensor_msgs::PointCloud2ConstIterator<std::uint8_t> red(cloud, "r");
  const sensor_msgs::PointCloud2ConstIterator<std::uint8_t> blue(cloud, "b");
  EXPECT_EQ(*red, 1);
  EXPECT_EQ(*blue, 3);
}

}  // namespace
}  // namespace facet_mapping
