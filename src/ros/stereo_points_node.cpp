// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/stereo_points_node.h"

#include <stdexcept>
#include <utility>

#include <sensor_msgs/PointCloud2.h>

#include "facet_mapping/points/stereo_pair_check.h"
#include "facet_mapping/points/stereo_points.h"
#include "facet_mapping/ros/cloud_conversions.h"
#include "facet_mapping/ros/image_conversions.h"
#include "facet_mapping/ros/node_setup.h"

namespace facet_mapping {
namespace {

enum Part { kLeft, kRight, kLeftInfo, kRightInfo, kSegmentation };

constexpr std::uint32_t kQueueSize = 20;  // of each topic
constexpr double kInfoWaitS = 0.5;        // then the last camera_info serves
constexpr std::size_t kMaxWaitingFrames = 200;
constexpr double kPollPeriodS = 0.1;
constexpr std::size_t kFirstChecks = 3;   // the first pairs are all checked ...
constexpr std::size_t kCheckPeriod = 10;  // ... then every so many; a check costs some 20 ms

std::vector<StampSync::Part> parts_of(const SegmentationInput& config) {
  std::vector<StampSync::Part> parts{{"left/image_rect"},
                                     {"right/image_rect"},
                                     {"left/camera_info", false, kInfoWaitS},
                                     {"right/camera_info", false, kInfoWaitS}};
  if (config.use_segmentation) {
    parts.push_back({"segmentation", false, config.timeout_s});
  }
  return parts;
}

std::string name_of(StereoPairProblem problem) {
  switch (problem) {
    case StereoPairProblem::kNone:
      return "";
    case StereoPairProblem::kBlank:
      return "blank image";
    case StereoPairProblem::kSwapped:
      return "left and right swapped";
    case StereoPairProblem::kRowsDiffer:
      return "unrectified pair";
    case StereoPairProblem::kNoMatch:
      return "images without common corners";
    case StereoPairProblem::kExposure:
      return "exposures differ";
  }
  return "";
}

}  // namespace

/// All that the matcher needs, checked.
struct StereoPointsNode::Pair {
  std_msgs::Header header;
  cv::Mat left;
  cv::Mat right;
  PinholeCamera camera;
  double baseline_m = 0.0;
  boost::shared_ptr<const void> segmentation;
};

StereoPointsNode::StereoPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : labels_(set_up_node(parameter_table(&config_), private_nh, &config_.segmentation.label_file)),
      diagnostics_(nh, private_nh),
      segmentation_(config_.segmentation, labels_, &diagnostics_),
      sync_(parts_of(config_.segmentation), config_.segmentation.cache_s, kMaxWaitingFrames),
      jobs_(static_cast<std::size_t>(config_.queue_size),
            [this](const std::string& error) { diagnostics_.complain("matcher failed", error); }) {
  config_.stereo.excluded_labels = labels_.sky_ids();
  points_pub_ = nh.advertise<sensor_msgs::PointCloud2>("points", kQueueSize);
  diagnostics_.on_publish([this] { refresh_diagnostics(); });
  subscribe(nh);
  poll_timer_ = nh.createWallTimer(ros::WallDuration(kPollPeriodS), [this](const auto&) {
    for (const StampedParts& parts : sync_.poll(ros::WallTime::now())) {
      accept(parts);
    }
  });
}

StereoPointsNode::~StereoPointsNode() {
  stop();
}

void StereoPointsNode::stop() {
  jobs_.stop();
}

template <typename Message>
ros::Subscriber StereoPointsNode::subscribe_part(ros::NodeHandle* nh,
                                                 const std::string& topic,
                                                 int part) {
  const std::string resolved = nh->resolveName(topic);
  topics_.push_back(resolved);
  diagnostics_.expect_input(resolved);
  return nh->subscribe<Message>(
      topic, kQueueSize, [this, part, resolved](const boost::shared_ptr<const Message>& message) {
        diagnostics_.count_input(resolved);
        receive(part, message->header.stamp, message);
      });
}

void StereoPointsNode::subscribe(ros::NodeHandle nh) {
  using sensor_msgs::CameraInfo;
  using sensor_msgs::Image;
  subscribers_.push_back(subscribe_part<Image>(&nh, "left/image_rect", kLeft));
  subscribers_.push_back(subscribe_part<Image>(&nh, "right/image_rect", kRight));
  subscribers_.push_back(subscribe_part<CameraInfo>(&nh, "left/camera_info", kLeftInfo));
  subscribers_.push_back(subscribe_part<CameraInfo>(&nh, "right/camera_info", kRightInfo));
  if (config_.segmentation.use_segmentation) {
    segmentation_.subscribe(nh, [this](const ros::Time& stamp, boost::shared_ptr<const void> m) {
      receive(kSegmentation, stamp, std::move(m));
    });
  }
}

void StereoPointsNode::receive(int part,
                               const ros::Time& stamp,
                               boost::shared_ptr<const void> message) {
  if (stamp.isZero()) {
    diagnostics_.complain("no stamp",
                          "a message has no stamp in its header; images, camera_info and "
                          "segmentation are paired by it: set it in the driver");
    return;
  }
  if (time_jump_.jumped_back(std::to_string(part), stamp)) {
    diagnostics_.complain("time jumped back",
                          "stamps jumped back by " + std::to_string(time_jump_.jump_s()) +
                              " s (a bag in a loop?); frames that waited for a part are dropped");
    sync_.clear();
  }
  if (part == kLeftInfo || part == kRightInfo) {
    last_info_[part - kLeftInfo] =
        boost::static_pointer_cast<const sensor_msgs::CameraInfo>(message);
  }
  for (const StampedParts& parts :
       sync_.add(part, stamp, std::move(message), ros::WallTime::now())) {
    accept(parts);
  }
}

boost::shared_ptr<const sensor_msgs::CameraInfo> StereoPointsNode::info_of(
    const StampedParts& parts, int part) {
  auto info = parts.get<sensor_msgs::CameraInfo>(part);
  if (info == nullptr) {
    info = last_info_[part - kLeftInfo];
  }
  if (info == nullptr) {
    throw std::invalid_argument("no message on '" + topics_[part] +
                                "' yet: without intrinsics the pair is dropped");
  }
  return info;
}

StereoPointsNode::Pair StereoPointsNode::convert(const StampedParts& parts) {
  Pair pair;
  const auto left = parts.get<sensor_msgs::Image>(kLeft);
  const auto right = parts.get<sensor_msgs::Image>(kRight);
  pair.header = left->header;
  pair.left = gray_from_message(*left, topics_[kLeft]);
  pair.right = gray_from_message(*right, topics_[kRight]);
  if (pair.left.size() != pair.right.size()) {
    throw std::invalid_argument("'" + topics_[kLeft] + "' and '" + topics_[kRight] +
                                "' have different sizes; rectify both to the same size");
  }
  const auto left_info = info_of(parts, kLeftInfo);
  const auto right_info = info_of(parts, kRightInfo);
  pair.camera = camera_from_info(*left_info, pair.left.size(), topics_[kLeft]);
  camera_from_info(*right_info, pair.right.size(), topics_[kRight]);
  pair.baseline_m = baseline_from_info(*left_info, *right_info);
  if (config_.segmentation.use_segmentation) {
    pair.segmentation = parts.parts[kSegmentation];
  }
  return pair;
}

void StereoPointsNode::accept(const StampedParts& parts) {
  diagnostics_.count("pairs");
  if (points_pub_.getNumSubscribers() == 0) {
    diagnostics_.count("pairs skipped without subscriber");
    return;
  }
  if (config_.segmentation.use_segmentation && parts.parts[kSegmentation] == nullptr) {
    diagnostics_.complain("no segmentation",
                          "no segmentation for the image at " +
                              std::to_string(parts.stamp.toSec()) + " within " +
                              std::to_string(config_.segmentation.timeout_s) +
                              " s: the pair goes on unlabelled. It must carry the image's exact "
                              "stamp; raise segmentation_timeout_s for a slow network, or set "
                              "use_segmentation to false");
  }
  try {
    Pair pair = convert(parts);
    if (!jobs_.post([this, pair = std::move(pair)] { match(pair); })) {
      diagnostics_.complain("matcher too slow",
                            std::to_string(config_.queue_size) +
                                " pairs wait already, one is dropped: lower the frame rate, the "
                                "image size or stereo/num_disparities, or raise queue_size");
    }
  } catch (const std::invalid_argument& e) {
    diagnostics_.complain("unusable pair", e.what());
  }
}

void StereoPointsNode::check(const Pair& pair) {
  const std::size_t index = matched_pairs_++;
  if (index >= kFirstChecks && index % kCheckPeriod != 0) {
    return;
  }
  StereoPairCheckConfig config;
  config.search_px = config_.stereo.num_disparities;
  const StereoPairReport report = check_stereo_pair(pair.left, pair.right, config);
  if (report.problem != StereoPairProblem::kNone) {
    diagnostics_.complain(
        name_of(report.problem),
        "'" + topics_[kLeft] + "' and '" + topics_[kRight] + "': " + report.sentence);
  }
  if (report.matched > 0) {
    diagnostics_.set("rows between the images, px", report.row_error_px);
  }
}

void StereoPointsNode::match(const Pair& pair) {
  const ros::WallTime start = ros::WallTime::now();
  check(pair);
  const cv::Mat labels = segmentation_.read(pair.segmentation, pair.left.size());
  std::vector<LabeledPoint> points =
      stereo_points(pair.left, pair.right, labels, pair.camera, pair.baseline_m, config_.stereo);
  if (points.empty()) {
    diagnostics_.complain("no points",
                          "not one point could be matched in a pair; is it rectified, textured, "
                          "and not swapped?");
  }
  const std::vector<LabeledPoint> sky =
      sky_points(labels, pair.camera, labels_.sky_ids(), config_.sky);
  points.insert(points.end(), sky.begin(), sky.end());
  points_pub_.publish(cloud_from_points(points, pair.header));
  diagnostics_.count("clouds published");
  diagnostics_.count("points published", points.size() - sky.size());
  diagnostics_.count("rays toward the sky", sky.size());
  diagnostics_.set("seconds of the last pair", (ros::WallTime::now() - start).toSec());
}

void StereoPointsNode::refresh_diagnostics() {
  const StampSync::Counts& counts = sync_.counts();
  diagnostics_.set("frames waiting for a part", static_cast<double>(sync_.waiting()));
  diagnostics_.set("messages too late for their frame", static_cast<double>(counts.late));
  diagnostics_.set("pairs waiting for the matcher", static_cast<double>(jobs_.size()));
  if (counts.unpaired > unpaired_) {
    diagnostics_.complain("unpaired images",
                          std::to_string(counts.unpaired - unpaired_) +
                              " stamps had no image on both '" + topics_[kLeft] + "' and '" +
                              topics_[kRight] +
                              "' and were dropped: the cameras must be triggered together and "
                              "carry exactly the same stamp");
    unpaired_ = counts.unpaired;
  }
}

}  // namespace facet_mapping
