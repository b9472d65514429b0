// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/segmentation_reader.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "seen_classes.h"

#include "facet_mapping/geometry/size_text.h"
#include "facet_mapping/ros/image_conversions.h"

namespace facet_mapping {
namespace {

enum Part { kLabels, kConfidence };

constexpr std::uint32_t kQueueSize = 50;
constexpr std::size_t kMaxWaitingFrames = 200;
constexpr double kPollPeriodS = 0.1;
/// Of the time that an image waits for its classes, so that these are not late for the image.
constexpr double kConfidenceShare = 0.5;
/// Shapes may differ by what whole pixels make of them.
constexpr double kShapeTolerance = 0.02;

std::vector<StampSync::Part> parts_of(const SegmentationInput& config) {
  const bool with_confidence = config.min_confidence > 0.0;
  return {{"segmentation"},
          {"segmentation_confidence",
           false,
           with_confidence ? kConfidenceShare * config.timeout_s : 0.0}};
}

bool have_same_shape(const cv::Size& a, const cv::Size& b) {
  const double ratio =
      static_cast<double>(a.width) * b.height / (static_cast<double>(a.height) * b.width);
  return std::abs(ratio - 1.0) < kShapeTolerance;
}

}  // namespace

struct SegmentationReader::Parts {
  boost::shared_ptr<const void> labels;
  boost::shared_ptr<const void> confidence;  ///< sensor_msgs/Image; null: none
};

SegmentationReader::SegmentationReader(const SegmentationInput& config,
                                       const LabelSet& labels,
                                       NodeDiagnostics* diagnostics)
    : config_(config),
      labels_(labels),
      diagnostics_(diagnostics),
      sync_(parts_of(config), config.cache_s, kMaxWaitingFrames),
      seen_(std::make_unique<SeenClasses>(labels_)) {
  diagnostics_->set("class ids configured", seen_->configured());
}

SegmentationReader::~SegmentationReader() = default;

template <typename Message>
ros::Subscriber SegmentationReader::subscribe_part(ros::NodeHandle* nh,
                                                   const std::string& topic,
                                                   int part) {
  const std::string resolved = nh->resolveName(topic);
  diagnostics_->expect_input(resolved);
  return nh->subscribe<Message>(
      topic, kQueueSize, [this, part, resolved](const boost::shared_ptr<const Message>& message) {
        diagnostics_->count_input(resolved);
        receive(part, message->header.stamp, message);
      });
}

void SegmentationReader::subscribe(ros::NodeHandle nh, Receive receive) {
  receive_ = std::move(receive);
  const bool raw = config_.transport == ImageTransport::kRaw;
  const std::string name = raw ? "segmentation" : "segmentation/compressed";
  topic_ = nh.resolveName(name);
  subscriber_ = raw ? subscribe_part<sensor_msgs::Image>(&nh, name, kLabels)
                    : subscribe_part<sensor_msgs::CompressedImage>(&nh, name, kLabels);
  if (config_.min_confidence > 0.0) {
    confidence_topic_ = nh.resolveName("segmentation_confidence");
    confidence_subscriber_ =
        subscribe_part<sensor_msgs::Image>(&nh, "segmentation_confidence", kConfidence);
    poll_timer_ = nh.createWallTimer(ros::WallDuration(kPollPeriodS), [this](const auto&) {
      deliver(sync_.poll(ros::WallTime::now()));
    });
  }
}

void SegmentationReader::receive(int part,
                                 const ros::Time& stamp,
                                 const boost::shared_ptr<const void>& message) {
  if (config_.min_confidence == 0.0) {
    deliver({{stamp, {message, nullptr}}});
    return;
  }
  if (time_jump_.jumped_back(std::to_string(part), stamp)) {
    sync_.clear();
  }
  deliver(sync_.add(static_cast<std::size_t>(part), stamp, message, ros::WallTime::now()));
}

void SegmentationReader::deliver(const std::vector<StampedParts>& ready) {
  for (const StampedParts& frame : ready) {
    auto parts = boost::make_shared<Parts>();
    parts->labels = frame.parts[kLabels];
    parts->confidence = frame.parts[kConfidence];
    receive_(frame.stamp, parts);
  }
}

cv::Mat SegmentationReader::decode(const boost::shared_ptr<const void>& labels,
                                   LabelImageReport* report) const {
  if (config_.transport == ImageTransport::kRaw) {
    const auto image = boost::static_pointer_cast<const sensor_msgs::Image>(labels);
    return labels_from_message(*image, labels_, topic_, report);
  }
  const auto image = boost::static_pointer_cast<const sensor_msgs::CompressedImage>(labels);
  return labels_from_message(*image, labels_, topic_, report);
}

cv::Mat SegmentationReader::read(const boost::shared_ptr<const void>& message,
                                 const cv::Size& image_size) {
  if (message == nullptr) {
    return {};
  }
  const auto parts = boost::static_pointer_cast<const Parts>(message);
  try {
    LabelImageReport report;
    cv::Mat labels = decode(parts->labels, &report);
    note(labels, report);
    if (config_.min_confidence > 0.0) {
      hide_unsure(parts->confidence, &labels);
    }
    return fit(labels, image_size);
  } catch (const std::invalid_argument& e) {
    diagnostics_->complain("unusable segmentation",
                           std::string(e.what()) + "; the frame goes on unlabelled");
  }
  return {};
}

cv::Mat SegmentationReader::fit(const cv::Mat& labels, const cv::Size& image_size) {
  if (labels.size() == image_size) {
    return labels;
  }
  const std::string sizes = "'" + topic_ + "' is " + size_text(labels.size()) +
                            " pixels, its image " + size_text(image_size);
  if (config_.resize && have_same_shape(labels.size(), image_size)) {
    diagnostics_->complain("segmentation resampled",
                           sizes +
                               "; it is resampled to the nearest pixel, which is right if both "
                               "show the same field of view. Borders are as coarse as the "
                               "smaller one: publish the image's size if you can");
    return resize_label_image(labels, image_size);
  }
  diagnostics_->complain(
      "segmentation of another size",
      sizes + "; the frame goes on unlabelled. Publish the same size" +
          (config_.resize ? ", or one of the same shape that shows the same field of view"
                          : ", or set resize_segmentation if both show the same field of view"));
  return {};
}

void SegmentationReader::hide_unsure(const boost::shared_ptr<const void>& confidence,
                                     cv::Mat* labels) {
  if (confidence == nullptr) {
    diagnostics_->complain("no confidence",
                           "no image on '" + confidence_topic_ +
                               "' with the stamp of the segmentation: all its pixels are taken for "
                               "sure. Publish both together, or set min_confidence to 0");
    return;
  }
  try {
    const auto image = boost::static_pointer_cast<const sensor_msgs::Image>(confidence);
    hide_unsure_pixels(
        confidence_from_message(*image, confidence_topic_), config_.min_confidence, labels);
  } catch (const std::invalid_argument& e) {
    diagnostics_->complain("unusable confidence",
                           std::string(e.what()) + "; all pixels are taken for sure");
  }
}

void SegmentationReader::note(const cv::Mat& ids, const LabelImageReport& report) {
  std::string unknown;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    seen_->add(ids, report);
    unknown = seen_->unknown();
    diagnostics_->set("class ids seen", seen_->seen());
    diagnostics_->set("class ids never seen", seen_->never_seen());
  }
  if (report.clean()) {
    return;
  }
  diagnostics_->set("class ids unknown", unknown);
  diagnostics_->complain("unknown classes",
                         "'" + topic_ + "': " + report.to_string() +
                             "; these pixels are unlabelled. Configured are the ids " +
                             seen_->configured() + ": check label_file '" + config_.label_file +
                             "'");
}

}  // namespace facet_mapping
