// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/segmenter_node.h"

#include <stdexcept>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include "facet_mapping/ros/file_paths.h"
#include "facet_mapping/ros/node_setup.h"

namespace facet_mapping {
namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr std::uint32_t kQueueSize = 20;  // of each topic
constexpr Label kLargestNarrowId = 254;
constexpr double kRateSlack = 0.9;  // so that jitter does not halve a camera's own rate

std::unique_ptr<Segmenter> make_segmenter(SegmenterNodeConfig* config, const LabelSet& labels) {
  const std::string model = folder_path(config->model);  // ~ and relative paths as elsewhere
  if (config->backend == SegmenterBackend::kForest) {
    config->forest.min_confidence = config->min_confidence;
    ForestModel forest = load_forest(model);
    if (forest.cells.use_view) {
      throw std::runtime_error("The forest '" + model +
                               "' needs the cameras' poses, which this node does not know; train "
                               "it without --use-pose");
    }
    return std::make_unique<ForestSegmenter>(std::move(forest), labels, config->forest);
  }
  config->network.model = model;
  config->network.class_map = folder_path(config->network.class_map);
  config->network.scales = numbers_from(config->scales);
  config->network.min_confidence = config->min_confidence;
  return std::make_unique<NetworkSegmenter>(config->network, labels);
}

bool has_wide_ids(const LabelSet& labels) {
  for (const ClassInfo& info : labels.classes()) {
    if (!info.ignore && info.id > kLargestNarrowId) {
      return true;
    }
  }
  return false;
}

cv::Mat to_8_bits(const cv::Mat& image, double scale = 1.0) {
  cv::Mat narrow;
  image.convertTo(narrow, CV_8U, scale);  // saturates 65535 to 255
  return narrow;
}

cv::Mat color_from_message(const sensor_msgs::Image& image, const std::string& topic) {
  if (image.width == 0 || image.height == 0 ||
      image.data.size() != static_cast<std::size_t>(image.step) * image.height) {
    throw std::invalid_argument("'" + topic +
                                "': the image is empty, damaged or truncated; check its source");
  }
  try {
    return cv_bridge::toCvCopy(image, encodings::BGR8)->image;
  } catch (const std::exception& e) {  // of cv_bridge or OpenCV
    throw std::invalid_argument("'" + topic + "': encoding '" + image.encoding +
                                "' cannot be turned into colour; publish rgb8, bgr8 or mono8 (" +
                                e.what() + ")");
  }
}

}  // namespace

SegmenterNode::SegmenterNode(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : labels_(set_up_node(parameter_table(&config_), private_nh, &config_.label_file)),
      diagnostics_(nh, private_nh),
      segmenter_(make_segmenter(&config_, labels_)),
      wide_ids_(has_wide_ids(labels_)),
      topic_(nh.resolveName("image_rect")),
      jobs_(static_cast<std::size_t>(config_.queue_size) + 1, [this](const std::string& error) {
        diagnostics_.complain("segmentation failed", error);
      }) {
  labels_pub_ = nh.advertise<sensor_msgs::Image>("segmentation", kQueueSize);
  confidence_pub_ = nh.advertise<sensor_msgs::Image>("segmentation_confidence", kQueueSize);
  diagnostics_.expect_input(topic_);
  diagnostics_.on_publish(
      [this] { diagnostics_.set("images waiting", static_cast<double>(waiting())); });
  subscriber_ = nh.subscribe<sensor_msgs::Image>(
      "image_rect", kQueueSize, [this](const sensor_msgs::ImageConstPtr& image) {
        receive(image);
      });
}

SegmenterNode::~SegmenterNode() {
  stop();
}

void SegmenterNode::stop() {
  jobs_.stop();
}

std::size_t SegmenterNode::waiting() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_.size();
}

bool SegmenterNode::is_wanted(const ros::Time& stamp) {
  if (time_jump_.jumped_back(topic_, stamp)) {
    diagnostics_.complain(
        "time jumped back",
        "stamps jumped back by " + std::to_string(time_jump_.jump_s()) + " s (a bag in a loop?)");
    last_stamp_ = ros::Time();
  }
  const double passed_s = (stamp - last_stamp_).toSec();
  if (!last_stamp_.isZero() && passed_s * config_.max_rate_hz < kRateSlack &&
      config_.max_rate_hz > 0.0) {
    diagnostics_.count("images skipped by max_rate_hz");
    return false;
  }
  last_stamp_ = stamp;
  return true;
}

void SegmenterNode::receive(const sensor_msgs::ImageConstPtr& image) {
  diagnostics_.count_input(topic_);
  if (labels_pub_.getNumSubscribers() + confidence_pub_.getNumSubscribers() == 0) {
    diagnostics_.count("images skipped without subscriber");
    return;
  }
  if (image->header.stamp.isZero()) {
    diagnostics_.complain("no stamp",
                          "an image has no stamp in its header, by which its segmentation would be "
                          "paired with it: set it in the driver");
    return;
  }
  if (is_wanted(image->header.stamp)) {
    queue(image);
  }
}

void SegmenterNode::queue(const sensor_msgs::ImageConstPtr& image) {
  bool dropped = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.push_back(image);
    dropped = waiting_.size() > static_cast<std::size_t>(config_.queue_size);
    if (dropped) {
      waiting_.pop_front();
    }
  }
  if (dropped) {
    diagnostics_.complain("segmenter too slow",
                          std::to_string(config_.queue_size) +
                              " images wait already, the oldest is dropped: set max_rate_hz, or "
                              "take a smaller input or model");
  }
  // Refused only if as many jobs wait as images can: each of them takes one.
  jobs_.post([this] { work_on_oldest(); });
}

void SegmenterNode::work_on_oldest() {
  sensor_msgs::ImageConstPtr image;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.empty()) {
      return;
    }
    image = waiting_.front();
    waiting_.pop_front();
  }
  try {
    segment(*image);
  } catch (const std::invalid_argument& e) {
    diagnostics_.complain("unusable image", e.what());
  }
}

void SegmenterNode::segment(const sensor_msgs::Image& image) {
  const ros::WallTime start = ros::WallTime::now();
  cv::Mat confidence;
  const cv::Mat ids = segmenter_->segment(color_from_message(image, topic_), &confidence);
  const std::string& encoding = wide_ids_ ? encodings::MONO16 : encodings::MONO8;
  const cv::Mat pixels = wide_ids_ ? ids : to_8_bits(ids);
  labels_pub_.publish(cv_bridge::CvImage(image.header, encoding, pixels).toImageMsg());
  if (confidence_pub_.getNumSubscribers() > 0) {
    const cv::Mat levels = to_8_bits(confidence, 255.0);
    confidence_pub_.publish(
        cv_bridge::CvImage(image.header, encodings::MONO8, levels).toImageMsg());
  }
  diagnostics_.count("images segmented");
  diagnostics_.set("seconds of the last image", (ros::WallTime::now() - start).toSec());
}

}  // namespace facet_mapping
