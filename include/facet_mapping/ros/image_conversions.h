// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images and camera_info messages to what the core works with. All functions throw
// std::invalid_argument with a sentence that says what is wrong and what to do.
#pragma once

#include <string>

#include <opencv2/core.hpp>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/labels/label_image.h"

namespace facet_mapping {

/// The rectified camera of `image_rect`: focal lengths and principal point from P, or from K if P
/// is not set and there is no distortion. `size` is that of the image. `topic`: for the sentence,
/// and to tell a raw image by its name.
PinholeCamera camera_from_info(const sensor_msgs::CameraInfo& info,
                               const cv::Size& size,
                               const std::string& topic);

/// Distance of the right camera from the left one in metres, from the two projections:
/// P[3] = -fx * baseline. Refuses swapped cameras and pairs without a baseline.
double baseline_from_info(const sensor_msgs::CameraInfo& left,
                          const sensor_msgs::CameraInfo& right);

/// CV_8UC1 grey image of any usual encoding (mono, colour, Bayer).
cv::Mat gray_from_message(const sensor_msgs::Image& image, const std::string& topic);

/// CV_16UC1 class ids of a label image.
cv::Mat labels_from_message(const sensor_msgs::Image& image,
                            const LabelSet& labels,
                            const std::string& topic,
                            LabelImageReport* report);

/// The same for PNG; lossy formats are refused, since they invent classes at every border.
cv::Mat labels_from_message(const sensor_msgs::CompressedImage& image,
                            const LabelSet& labels,
                            const std::string& topic,
                            LabelImageReport* report);

/// CV_32FC1, 0 to 1, of a confidence image: mono8 or mono16 (the largest value is certain), or
/// 32FC1 from 0 to 1.
cv::Mat confidence_from_message(const sensor_msgs::Image& image, const std::string& topic);

/// Makes pixels of class ids (CV_16UC1) kUnlabelled whose confidence (CV_32FC1, of any size of the
/// same field of view) is below `min_confidence` or not a number.
void hide_unsure_pixels(const cv::Mat& confidence, double min_confidence, cv::Mat* labels);

}  // namespace facet_mapping
