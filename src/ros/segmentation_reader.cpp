// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/segmentation_reader.h"

#include <stdexcept>
#include <utility>

#include "facet_mapping/ros/image_conversions.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 50;

std::string size_text(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

SegmentationReader::SegmentationReader(const SegmentationInput& config,
                                       const LabelSet& labels,
                                       NodeDiagnostics* diagnostics)
    : config_(config), labels_(labels), diagnostics_(diagnostics) {
  diagnostics_->set("class ids configured", configured_ids());
}

std::string SegmentationReader::configured_ids() const {
  std::string text;
  for (const ClassInfo& info : labels_.classes()) {
    text += (text.empty() ? "" : " ") + std::to_string(info.id);
  }
  return text;
}

void SegmentationReader::subscribe(ros::NodeHandle nh, Receive receive) {
  const bool raw = config_.transport == ImageTransport::kRaw;
  topic_ = nh.resolveName(raw ? "segmentation" : "segmentation/compressed");
  diagnostics_->expect_input(topic_);
  const auto count = [this, receive = std::move(receive)](const auto& message) {
    diagnostics_->count_input(topic_);
    receive(message->header.stamp, message);
  };
  if (raw) {
    subscriber_ = nh.subscribe<sensor_msgs::Image>(
        "segmentation", kQueueSize, [count](const sensor_msgs::ImageConstPtr& m) { count(m); });
  } else {
    subscriber_ = nh.subscribe<sensor_msgs::CompressedImage>(
        "segmentation/compressed",
        kQueueSize,
        [count](const sensor_msgs::CompressedImageConstPtr& m) { count(m); });
  }
}

cv::Mat SegmentationReader::decode(const boost::shared_ptr<const void>& message,
                                   LabelImageReport* report) const {
  if (config_.transport == ImageTransport::kRaw) {
    const auto image = boost::static_pointer_cast<const sensor_msgs::Image>(message);
    return labels_from_message(*image, labels_, topic_, report);
  }
  const auto image = boost::static_pointer_cast<const sensor_msgs::CompressedImage>(message);
  return labels_from_message(*image, labels_, topic_, report);
}

cv::Mat SegmentationReader::read(const boost::shared_ptr<const void>& message,
                                 const cv::Size& image_size) {
  if (message == nullptr) {
    return {};
  }
  try {
    LabelImageReport report;
    const cv::Mat labels = decode(message, &report);
    note(report);
    if (labels.size() == image_size) {
      return labels;
    }
    if (config_.resize) {
      return resize_label_image(labels, image_size);
    }
    diagnostics_->complain("segmentation of another size",
                           "'" + topic_ + "' is " + size_text(labels.size()) +
                               " pixels, its image " + size_text(image_size) +
                               "; the frame goes on unlabelled. Publish the same size, or set "
                               "resize_segmentation if both show the same field of view");
  } catch (const std::invalid_argument& e) {
    diagnostics_->complain("unusable segmentation",
                           std::string(e.what()) + "; the frame goes on unlabelled");
  }
  return {};
}

void SegmentationReader::note(const LabelImageReport& report) {
  if (report.clean()) {
    return;
  }
  std::string seen;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [id, pixels] : report.unknown_ids) {
      unknown_ids_[id] += pixels;
    }
    for (const auto& [id, pixels] : unknown_ids_) {
      seen += (seen.empty() ? "" : ", ") + std::to_string(id) + " (" + std::to_string(pixels) +
              " pixels)";
    }
  }
  diagnostics_->set("class ids unknown", seen);
  diagnostics_->complain("unknown classes",
                         "'" + topic_ + "': " + report.to_string() +
                             "; these pixels are unlabelled. Configured are the ids " +
                             configured_ids() + ": check label_file '" + config_.label_file + "'");
}

}  // namespace facet_mapping
