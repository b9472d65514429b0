// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The segmentation topic of a node: subscribing, decoding, checking against its image.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

#include <boost/shared_ptr.hpp>
#include <opencv2/core.hpp>
#include <ros/node_handle.h>

#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

class SegmentationReader {
 public:
  using Receive = std::function<void(const ros::Time& stamp, boost::shared_ptr<const void>)>;

  SegmentationReader(const SegmentationInput& config,
                     const LabelSet& labels,
                     NodeDiagnostics* diagnostics);

  /// Subscribes to `segmentation` or `segmentation/compressed`.
  void subscribe(ros::NodeHandle nh, Receive receive);

  /// CV_16UC1 ids of a message that `receive` was given, of the size of its image; an empty image,
  /// counted and explained, if it cannot be used. Thread-safe.
  cv::Mat read(const boost::shared_ptr<const void>& message, const cv::Size& image_size);

 private:
  cv::Mat decode(const boost::shared_ptr<const void>& message, LabelImageReport* report) const;
  void note(const LabelImageReport& report);
  std::string configured_ids() const;

  SegmentationInput config_;
  LabelSet labels_;
  NodeDiagnostics* diagnostics_;
  std::string topic_;
  ros::Subscriber subscriber_;
  std::mutex mutex_;
  std::map<int, std::size_t> unknown_ids_;
};

}  // namespace facet_mapping
