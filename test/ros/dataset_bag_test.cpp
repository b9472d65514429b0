// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/dataset_bag.h"

#include <map>
#include <set>
#include <stdexcept>

#include "support/small_datasets.h"
#include "support/small_disk.h"
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

namespace facet_mapping {
namespace {

using testing::error_of;
using testing::TempFolder;

constexpr double kEpoch = 1316995200.0;

class DatasetBag : public ::testing::Test {
 protected:
  DatasetBag() {
    testing::make_plain(folder_ / "set");
    dataset_ = read_dataset(folder_ / "set");
  }

  template <typename Message>
  std::vector<typename Message::ConstPtr> messages(const std::string& topic) {
    rosbag::Bag bag(path_, rosbag::bagmode::Read);
    std::vector<typename Message::ConstPtr> found;
    for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic))) {
      found.push_back(instance.instantiate<Message>());
      EXPECT_NE(found.back(), nullptr) << topic << " holds " << instance.getDataType();
    }
    return found;
  }

  std::set<std::string> topics() {
    rosbag::Bag bag(path_, rosbag::bagmode::Read);
    rosbag::View view(bag);
    std::set<std::string> names;
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      names.insert(connection->topic);
    }
    return names;
  }

  TempFolder folder_;
  Dataset dataset_;
  std::string path_ = folder_ / "out/drive.bag";
};

TEST_F(DatasetBag, HoldsTheUsualTopics) {
  std::vector<std::size_t> done;
  const DatasetBagReport report =
      write_dataset_bag(dataset_, path_, {}, [&](std::size_t k, std::size_t total) {
        EXPECT_EQ(total, 3U);
        done.push_back(k);
      });
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(report.frames, 3U);
  EXPECT_EQ(report.scans, 3U);
  EXPECT_EQ(report.label_images, 3U);
  EXPECT_EQ(report.messages, 1 + 3 * 7U);
  EXPECT_EQ(topics(),
            (std::set<std::string>{"/tf",
                                   "/tf_static",
                                   "/kitti/camera_color_left/image_raw",
                                   "/kitti/camera_color_left/camera_info",
                                   "/kitti/camera_color_left/segmentation",
                                   "/kitti/camera_color_right/image_raw",
                                   "/kitti/camera_color_right/camera_info",
                                   "/kitti/velo/pointcloud"}));
  const auto images = messages<sensor_msgs::Image>("/kitti/camera_color_left/image_raw");
  ASSERT_EQ(images.size(), 3U);
  EXPECT_EQ(images[2]->encoding, "bgr8");
  EXPECT_EQ(images[2]->header.frame_id, "camera_color_left");
  EXPECT_NEAR(images[2]->header.stamp.toSec(), kEpoch + 0.2, 1e-6);
  EXPECT_EQ(images[2]->data[3 * 8 * 5 + 3 * 7 + 0], 70);  // blue = 10 * column
  EXPECT_EQ(images[2]->data[3 * 8 * 5 + 3 * 7 + 2], 2);   // red = frame
}

TEST_F(DatasetBag, StampsOfOneFrameAreEqual) {
  write_dataset_bag(dataset_, path_);
  const auto left = messages<sensor_msgs::Image>("/kitti/camera_color_left/image_raw");
  const auto info = messages<sensor_msgs::CameraInfo>("/kitti/camera_color_right/camera_info");
  const auto labels = messages<sensor_msgs::Image>("/kitti/camera_color_left/segmentation");
  const auto tf = messages<tf2_msgs::TFMessage>("/tf");
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(left[k]->header.stamp, info[k]->header.stamp);
    EXPECT_EQ(left[k]->header.stamp, labels[k]->header.stamp);
    EXPECT_EQ(left[k]->header.stamp, tf[k]->transforms[0].header.stamp);
  }
}

TEST_F(DatasetBag, CameraInfoIsThatOfARectifiedPair) {
  write_dataset_bag(dataset_, path_);
  const auto left = messages<sensor_msgs::CameraInfo>("/kitti/camera_color_left/camera_info")[0];
  const auto right = messages<sensor_msgs::CameraInfo>("/kitti/camera_color_right/camera_info")[0];
  EXPECT_EQ(left->width, 8U);
  EXPECT_EQ(left->height, 6U);
  EXPECT_EQ(left->K[2], 4.0);
  EXPECT_EQ(left->P[0], 10.0);
  EXPECT_EQ(left->P[3], 0.0);
  EXPECT_EQ(right->P[3], -5.0);  // -fx * 0.5 m
  EXPECT_EQ(right->D, std::vector<double>(5, 0.0));
  EXPECT_EQ(right->R[0] + right->R[4] + right->R[8], 3.0);
}

TEST_F(DatasetBag, SegmentationAndScanKeepTheirValues) {
  dataset_.frames[1].labels = dataset_.frames[1].gt_labels;  // 255 everywhere: none
  write_dataset_bag(dataset_, path_);
  const auto labels = messages<sensor_msgs::Image>("/kitti/camera_color_left/segmentation");
  EXPECT_EQ(labels[2]->encoding, "mono8");
  EXPECT_EQ(labels[2]->data, std::vector<unsigned char>(8 * 6, 2));
  EXPECT_EQ(labels[1]->data, std::vector<unsigned char>(8 * 6, 255));
  const auto scan = messages<sensor_msgs::PointCloud2>("/kitti/velo/pointcloud")[0];
  EXPECT_EQ(scan->header.frame_id, "velo_link");
  EXPECT_EQ(scan->width, 2U);
  sensor_msgs::PointCloud2ConstIterator<float> z(*scan, "z");
  sensor_msgs::PointCloud2ConstIterator<float> intensity(*scan, "intensity");
  EXPECT_EQ(*(z + 1), -1.0F);
  EXPECT_EQ(*intensity, 0.25F);
}

TEST_F(DatasetBag, LargeIdsAreSixteenBitsWide) {
  cv::imwrite(dataset_.frames[0].labels,
              cv::Mat(testing::kHeight, testing::kWidth, CV_16U, cv::Scalar(300)));
  write_dataset_bag(dataset_, path_);
  const auto labels = messages<sensor_msgs::Image>("/kitti/camera_color_left/segmentation");
  EXPECT_EQ(labels[0]->encoding, "mono16");
  EXPECT_EQ(labels[0]->data[0] + 256 * labels[0]->data[1], 300);
  EXPECT_EQ(labels[1]->encoding, "mono8");
}

TEST_F(DatasetBag, TransformsLeadFromTheMapToEverySensor) {
  write_dataset_bag(dataset_, path_);
  const auto tf = messages<tf2_msgs::TFMessage>("/tf")[2]->transforms.at(0);
  EXPECT_EQ(tf.header.frame_id, "map");
  EXPECT_EQ(tf.child_frame_id, "base_link");
  const Eigen::Isometry3d map_from_base = tf2::transformToEigen(tf);
  // The car drives straight ahead: two metres along x, not turned.
  EXPECT_LT(
      (map_from_base.matrix() - Eigen::Isometry3d(Eigen::Translation3d(2, 0, 0)).matrix()).norm(),
      1e-9);
  std::map<std::string, geometry_msgs::TransformStamped> rig;
  const auto tf_static = messages<tf2_msgs::TFMessage>("/tf_static").at(0);
  for (const auto& transform : tf_static->transforms) {
    rig[transform.child_frame_id] = transform;
  }
  ASSERT_EQ(rig.size(), 3U);
  EXPECT_EQ(rig["camera_color_left"].header.frame_id, "base_link");
  EXPECT_EQ(rig["camera_color_right"].header.frame_id, "camera_color_left");
  EXPECT_EQ(rig["velo_link"].header.frame_id, "camera_color_left");
  const Eigen::Isometry3d base_from_left = tf2::transformToEigen(rig["camera_color_left"]);
  EXPECT_TRUE(
      (map_from_base * base_from_left).isApprox(dataset_.frames[2].view.world_from_cam, 1e-9));
  // The right camera stands 0.5 m to the right (-y), 0.01 m up and 0.02 m behind the left one.
  const Eigen::Vector3d right =
      (base_from_left * tf2::transformToEigen(rig["camera_color_right"])).translation();
  EXPECT_LT((right - Eigen::Vector3d(-0.02, -0.5, 0.01)).norm(), 1e-9);
  // The scanner stands 0.3 m behind the camera and 0.1 m above it.
  const Eigen::Vector3d scanner =
      (base_from_left * tf2::transformToEigen(rig["velo_link"])).translation();
  EXPECT_LT((scanner - Eigen::Vector3d(-0.3, 0, 0.1)).norm(), 1e-9);
}

TEST_F(DatasetBag, StaticTransformsAreLatched) {
  write_dataset_bag(dataset_, path_);
  rosbag::Bag bag(path_, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery("/tf_static"));
  ASSERT_EQ(view.getConnections().size(), 1U);
  EXPECT_EQ(view.getConnections()[0]->header->at("latching"), "1");
  EXPECT_EQ(view.getConnections()[0]->datatype, "tf2_msgs/TFMessage");
}

TEST_F(DatasetBag, OptionsLeaveThingsOut) {
  DatasetBagOptions options;
  options.topic_prefix = "/car";
  options.with_right = options.with_scans = options.with_labels = false;
  options.first_frame = 1;
  options.last_frame = 1;
  EXPECT_EQ(write_dataset_bag(dataset_, path_, options).frames, 1U);
  EXPECT_EQ(topics(),
            (std::set<std::string>{"/tf",
                                   "/tf_static",
                                   "/car/camera_color_left/image_raw",
                                   "/car/camera_color_left/camera_info"}));
  options.first_frame = 3;
  options.last_frame = 9;
  EXPECT_THROW(write_dataset_bag(dataset_, path_, options), std::invalid_argument);
}

TEST_F(DatasetBag, RawDrivesKeepTheirTime) {
  const Dataset raw = read_dataset(testing::make_raw(folder_ / "day"));
  write_dataset_bag(raw, path_);
  const auto images = messages<sensor_msgs::Image>("/kitti/camera_color_left/image_raw");
  EXPECT_NEAR(images[1]->header.stamp.toSec(), 1317042146.5, 1e-6);
  EXPECT_EQ(messages<sensor_msgs::PointCloud2>("/kitti/velo/pointcloud").size(), 1U);
}

TEST_F(DatasetBag, BrokenImagesLeaveNoBag) {
  testing::write_text(dataset_.frames[2].left_image, "broken");
  const std::string error = error_of([&] { write_dataset_bag(dataset_, path_); });
  EXPECT_NE(error.find("left/000002.png' is truncated"), std::string::npos) << error;
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
  cv::imwrite(dataset_.frames[2].left_image, cv::Mat(6, 9, CV_8UC3));
  const std::string size_error = error_of([&] { write_dataset_bag(dataset_, path_); });
  EXPECT_NE(size_error.find("000002.png' is 9x6 pixels"), std::string::npos) << size_error;
}

TEST_F(DatasetBag, FullDiskIsAnErrorAndLeavesNoBag) {
  std::string error;
  {
    const testing::SmallDisk disk(2000);
    error = error_of([&] { write_dataset_bag(dataset_, path_); });
  }
  EXPECT_NE(error.find("cannot write the bag '" + path_), std::string::npos) << error;
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
}

}  // namespace
}  // namespace facet_mapping
