// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The messages that a recorded drive holds, made from a dataset's files.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <geometry_msgs/TransformStamped.h>
#include <opencv2/core.hpp>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <tf2_msgs/TFMessage.h>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping::dataset_messages {

constexpr char kMapFrame[] = "map";
constexpr char kBaseFrame[] = "base_link";
constexpr char kLeftFrame[] = "camera_color_left";
constexpr char kRightFrame[] = "camera_color_right";
constexpr char kScannerFrame[] = "velo_link";

std_msgs::Header header(const ros::Time& stamp, const std::string& frame_id);

sensor_msgs::Image image(const std_msgs::Header& header,
                         const cv::Mat& pixels,
                         const std::string& encoding);

/// Class ids (CV_16UC1, kUnlabelled = none) as mono8 with 255 = none, or as mono16 if an id is too
/// large.
sensor_msgs::Image segmentation(const std_msgs::Header& header, const cv::Mat& labels);

/// A rectified camera; `baseline_m` is that of a right camera, 0 for the left one.
sensor_msgs::CameraInfo camera_info(const std_msgs::Header& header,
                                    const PinholeCamera& camera,
                                    double baseline_m);

sensor_msgs::PointCloud2 cloud(const std_msgs::Header& header,
                               const std::vector<Eigen::Vector4f>& points);

/// map -> base_link.
tf2_msgs::TFMessage pose(const ros::Time& stamp, const View& view);

/// base_link -> left camera -> right camera and scanner, where the dataset has them.
tf2_msgs::TFMessage rig(const ros::Time& stamp, const Dataset& dataset);

}  // namespace facet_mapping::dataset_messages
