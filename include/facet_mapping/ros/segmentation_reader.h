// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The segmentation topic of a node: subscribing, decoding, checking against its image.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>
#include <opencv2/core.hpp>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/stamp_sync.h"
#include "facet_mapping/ros/time_jump.h"

namespace facet_mapping {

class SeenClasses;

class SegmentationReader {
 public:
  using Receive = std::function<void(const ros::Time& stamp, boost::shared_ptr<const void>)>;

  SegmentationReader(const SegmentationInput& config,
                     const LabelSet& labels,
                     NodeDiagnostics* diagnostics);
  ~SegmentationReader();

  /// Subscribes to `segmentation` or `segmentation/compressed` and, with min_confidence, to
  /// `segmentation_confidence`, which is waited for.
  void subscribe(ros::NodeHandle nh, Receive receive);

  /// CV_16UC1 ids of a message that `receive` was given, of the size of its image; an empty image,
  /// counted and explained, if it cannot be used. Pixels that are not sure enough are kUnlabelled.
  /// Thread-safe.
  cv::Mat read(const boost::shared_ptr<const void>& message, const cv::Size& image_size);

 private:
  struct Parts;

  template <typename Message>
  ros::Subscriber subscribe_part(ros::NodeHandle* nh, const std::string& topic, int part);
  void receive(int part, const ros::Time& stamp, const boost::shared_ptr<const void>& message);
  void deliver(const std::vector<StampedParts>& ready);
  cv::Mat decode(const boost::shared_ptr<const void>& labels, LabelImageReport* report) const;
  cv::Mat fit(const cv::Mat& labels, const cv::Size& image_size);
  void hide_unsure(const boost::shared_ptr<const void>& confidence, cv::Mat* labels);
  void note(const cv::Mat& ids, const LabelImageReport& report);

  SegmentationInput config_;
  LabelSet labels_;
  NodeDiagnostics* diagnostics_;
  StampSync sync_;
  TimeJumpDetector time_jump_;
  Receive receive_;
  std::string topic_;
  std::string confidence_topic_;
  ros::Subscriber subscriber_;
  ros::Subscriber confidence_subscriber_;
  ros::WallTimer poll_timer_;
  std::mutex mutex_;
  std::unique_ptr<SeenClasses> seen_;
};

}  // namespace facet_mapping
