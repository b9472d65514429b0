// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/posed_images.h"

#include <stdexcept>
#include <utility>

#include "facet_mapping/ros/image_conversions.h"

namespace facet_mapping {
namespace {

enum Part { kImage, kInfo, kSegmentation };

constexpr std::uint32_t kQueueSize = 50;  // of each topic
constexpr double kInfoWaitS = 0.5;        // then the last camera_info serves
constexpr std::size_t kMaxWaitingFrames = 200;
constexpr double kPollPeriodS = 0.1;

std::vector<StampSync::Part> parts_of(const SegmentationInput& config) {
  std::vector<StampSync::Part> parts{{"image_rect"}, {"camera_info", false, kInfoWaitS}};
  if (config.use_segmentation) {
    parts.push_back({"segmentation", false, config.timeout_s});
  }
  return parts;
}

}  // namespace

PosedImages::PosedImages(ros::NodeHandle nh,
                         const SegmentationInput& config,
                         const LabelSet& labels,
                         TransformQueue* transforms,
                         NodeDiagnostics* diagnostics,
                         Callbacks callbacks)
    : config_(config),
      transforms_(transforms),
      diagnostics_(diagnostics),
      callbacks_(std::move(callbacks)),
      segmentation_(config, labels, diagnostics),
      sync_(parts_of(config), config.cache_s, kMaxWaitingFrames),
      image_topic_(nh.resolveName("image_rect")),
      info_topic_(nh.resolveName("camera_info")) {
  diagnostics_->expect_input(image_topic_);
  diagnostics_->expect_input(info_topic_);
  subscribe(nh);
  poll_timer_ = nh.createWallTimer(ros::WallDuration(kPollPeriodS), [this](const auto&) {
    for (const StampedParts& parts : sync_.poll(ros::WallTime::now())) {
      look_up_pose(parts);
    }
  });
}

void PosedImages::subscribe(ros::NodeHandle nh) {
  image_subscriber_ = nh.subscribe<sensor_msgs::Image>(
      "image_rect", kQueueSize, [this](const sensor_msgs::ImageConstPtr& message) {
        diagnostics_->count_input(image_topic_);
        receive(kImage, message->header.stamp, message);
      });
  info_subscriber_ = nh.subscribe<sensor_msgs::CameraInfo>(
      "camera_info", kQueueSize, [this](const sensor_msgs::CameraInfoConstPtr& message) {
        diagnostics_->count_input(info_topic_);
        last_info_ = message;
        receive(kInfo, message->header.stamp, message);
      });
  if (config_.use_segmentation) {
    segmentation_.subscribe(nh, [this](const ros::Time& stamp, boost::shared_ptr<const void> m) {
      receive(kSegmentation, stamp, std::move(m));
    });
  }
}

void PosedImages::receive(int part, const ros::Time& stamp, boost::shared_ptr<const void> message) {
  if (stamp.isZero()) {
    diagnostics_->complain("no stamp",
                           "a message has no stamp in its header; image, camera_info and "
                           "segmentation are paired by it: set it in the driver");
    return;
  }
  if (time_jump_.jumped_back(std::to_string(part), stamp)) {
    sync_.clear();
    callbacks_.on_time_jump(time_jump_.jump_s());
  }
  for (const StampedParts& parts :
       sync_.add(static_cast<std::size_t>(part), stamp, std::move(message), ros::WallTime::now())) {
    look_up_pose(parts);
  }
}

void PosedImages::look_up_pose(const StampedParts& parts) {
  const auto image = parts.get<sensor_msgs::Image>(kImage);
  transforms_->push(image->header.frame_id,
                    parts.stamp,
                    [this, parts](const Eigen::Isometry3d& pose) { accept(parts, pose); });
}

void PosedImages::accept(const StampedParts& parts, const Eigen::Isometry3d& map_from_camera) {
  if (callbacks_.is_wanted && !callbacks_.is_wanted(map_from_camera)) {
    return;
  }
  try {
    LabeledView view = convert(parts);
    view.view.world_from_cam = map_from_camera;
    view.stamp = parts.stamp.toSec();
    callbacks_.on_image(std::move(view), parts.get<sensor_msgs::Image>(kImage)->header);
  } catch (const std::invalid_argument& e) {
    diagnostics_->complain("unusable image", e.what());
  }
}

LabeledView PosedImages::convert(const StampedParts& parts) {
  sensor_msgs::CameraInfoConstPtr info = parts.get<sensor_msgs::CameraInfo>(kInfo);
  if (info == nullptr) {
    info = last_info_;
  }
  if (info == nullptr) {
    throw std::invalid_argument("no message on '" + info_topic_ +
                                "' yet: without intrinsics the image is dropped");
  }
  LabeledView view;
  view.gray = gray_from_message(*parts.get<sensor_msgs::Image>(kImage), image_topic_);
  view.view.camera = camera_from_info(*info, view.gray.size(), image_topic_);
  if (!config_.use_segmentation) {
    return view;
  }
  view.labels = segmentation_.read(parts.parts[kSegmentation], view.gray.size());
  if (parts.parts[kSegmentation] == nullptr) {
    diagnostics_->complain("no segmentation",
                           "no segmentation for the image at " +
                               std::to_string(parts.stamp.toSec()) + " within " +
                               std::to_string(config_.timeout_s) +
                               " s: the image goes on unlabelled. It must carry the image's exact "
                               "stamp; raise segmentation_timeout_s for a slow network, or set "
                               "use_segmentation to false");
  }
  return view;
}

void PosedImages::refresh_diagnostics() {
  const StampSync::Counts& counts = sync_.counts();
  diagnostics_->set("frames waiting for a part", static_cast<double>(sync_.waiting()));
  diagnostics_->set("messages too late for their frame", static_cast<double>(counts.late));
  if (counts.unpaired > unpaired_) {
    diagnostics_->complain("no image",
                           std::to_string(counts.unpaired - unpaired_) +
                               " stamps had a camera_info or segmentation, but no image on '" +
                               image_topic_ + "'");
    unpaired_ = counts.unpaired;
  }
}

}  // namespace facet_mapping
