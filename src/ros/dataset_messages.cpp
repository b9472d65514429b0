// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset_messages.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping::dataset_messages {
namespace {

// Body axes (x forward, y left, z up) of an optical frame (x right, y down, z forward).
Eigen::Isometry3d optical_from_base() {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;
  return transform;
}

geometry_msgs::TransformStamped transform(const std_msgs::Header& header,
                                          const std::string& child,
                                          const Eigen::Isometry3d& parent_from_child) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(parent_from_child);
  message.header = header;
  message.child_frame_id = child;
  return message;
}

}  // namespace

std_msgs::Header header(const ros::Time& stamp, const std::string& frame_id) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame_id;
  return header;
}

sensor_msgs::Image image(const std_msgs::Header& header,
                         const cv::Mat& pixels,
                         const std::string& encoding) {
  return *cv_bridge::CvImage(header, encoding, pixels).toImageMsg();
}

sensor_msgs::Image segmentation(const std_msgs::Header& header, const cv::Mat& labels) {
  namespace encodings = sensor_msgs::image_encodings;
  constexpr int kLargestByteId = 254;
  if (cv::countNonZero((labels > kLargestByteId) & (labels != kUnlabelled)) > 0) {
    return image(header, labels, encodings::MONO16);
  }
  cv::Mat bytes;
  labels.convertTo(bytes, CV_8U);  // saturates: kUnlabelled becomes 255
  return image(header, bytes, encodings::MONO8);
}

sensor_msgs::CameraInfo camera_info(const std_msgs::Header& header,
                                    const PinholeCamera& camera,
                                    double baseline_m) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {camera.fx,
            0.0,
            camera.cx,
            -camera.fx * baseline_m,
            0.0,
            camera.fy,
            camera.cy,
            0.0,
            0.0,
            0.0,
            1.0,
            0.0};
  return info;
}

sensor_msgs::PointCloud2 cloud(const std_msgs::Header& header,
                               const std::vector<Eigen::Vector4f>& points) {
  sensor_msgs::PointCloud2 message;
  message.header = header;
  message.height = 1;
  message.is_dense = true;
  sensor_msgs::PointCloud2Modifier modifier(message);
  constexpr auto kFloat = sensor_msgs::PointField::FLOAT32;
  modifier.setPointCloud2Fields(
      4, "x", 1, kFloat, "y", 1, kFloat, "z", 1, kFloat, "intensity", 1, kFloat);
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> values(message, "x");
  for (const Eigen::Vector4f& point : points) {
    for (int k = 0; k < 4; ++k) {
      values[k] = point[k];
    }
    message.is_dense = message.is_dense && point.allFinite();
    ++values;
  }
  return message;
}

tf2_msgs::TFMessage pose(const ros::Time& stamp, const View& view) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(
      transform(header(stamp, kMapFrame), kBaseFrame, view.world_from_cam * optical_from_base()));
  return message;
}

tf2_msgs::TFMessage rig(const ros::Time& stamp, const Dataset& dataset) {
  tf2_msgs::TFMessage message;
  const std_msgs::Header left = header(stamp, kLeftFrame);
  message.transforms.push_back(transform(
      header(stamp, kBaseFrame), kLeftFrame, optical_from_base().inverse(Eigen::Isometry)));
  if (dataset.has_right) {
    message.transforms.push_back(
        transform(left, kRightFrame, dataset.right_from_left.inverse(Eigen::Isometry)));
  }
  if (dataset.has_scans) {
    message.transforms.push_back(transform(left, kScannerFrame, dataset.left_from_velo));
  }
  return message;
}

}  // namespace facet_mapping::dataset_messages
