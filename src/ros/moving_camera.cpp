// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/moving_camera.h"

#include <limits>
#include <utility>

#include <sensor_msgs/PointCloud2.h>

#include "facet_mapping/points/sky_points.h"
#include "facet_mapping/ros/cloud_conversions.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 50;  // clouds
constexpr double kIdlePollS = 0.25;
/// So many images without parallax at the very start say that something is wrong.
constexpr std::size_t kPatience = 50;

}  // namespace

MovingCamera::MovingCamera(const ros::NodeHandle& nh,
                           const MovingCameraConfig& config,
                           const LabelSet& labels,
                           NodeDiagnostics* diagnostics,
                           Source source)
    : config_(config),
      labels_(labels),
      diagnostics_(diagnostics),
      source_(std::move(source)),
      tf_listener_(tf_buffer_, nh),
      transforms_(nh, &tf_buffer_, config.pose, diagnostics),
      points_pub_(ros::NodeHandle(nh).advertise<sensor_msgs::PointCloud2>("points", kQueueSize)),
      jobs_(static_cast<std::size_t>(config.queue_size),
            [this](const std::string& error) { diagnostics_->complain("worker failed", error); }),
      images_(nh,
              config.segmentation,
              labels,
              &transforms_,
              diagnostics,
              {[this](const Eigen::Isometry3d& /*pose*/) { return is_listened_to(); },
               [this](LabeledView view, const std_msgs::Header& header) {
                 on_image(std::move(view), header);
               },
               [this](double jump_s) { on_time_jump(jump_s); }}) {
  diagnostics_->on_publish([this] { refresh_diagnostics(); });
  idle_timer_ = nh.createWallTimer(ros::WallDuration(kIdlePollS),
                                   [this](const ros::WallTimerEvent&) { flush_if_idle(); });
}

MovingCamera::~MovingCamera() {
  stop();
}

void MovingCamera::stop() {
  jobs_.stop();
}

bool MovingCamera::is_listened_to() {
  const bool listened_to = points_pub_.getNumSubscribers() > 0;
  if (!listened_to) {
    diagnostics_->count("images skipped without subscriber");
  }
  return listened_to;
}

void MovingCamera::on_image(LabeledView view, const std_msgs::Header& header) {
  diagnostics_->count("images");
  last_image_ = ros::WallTime::now();
  is_flushed_ = false;
  if (!jobs_.post([this, view = std::move(view), header] { work(view, header); })) {
    diagnostics_->complain("worker too slow",
                           std::to_string(config_.queue_size) +
                               " images wait already, one is dropped: lower the frame rate or the "
                               "image size, or raise queue_size (the points then come later)");
  }
}

void MovingCamera::on_time_jump(double jump_s) {
  diagnostics_->complain("time jumped back",
                         "image stamps jumped back by " + std::to_string(jump_s) +
                             " s (a bag in a loop?): what was followed is given up");
  transforms_.clear();
  tf_buffer_.clear();  // static transforms survive this
  jobs_.post([this] {
    source_.finish();
    pending_.clear();
    used_since_flush_ = 0;
  });
}

void MovingCamera::work(const LabeledView& view, const std_msgs::Header& header) {
  const ros::WallTime start = ros::WallTime::now();
  bool used = false;
  std::vector<PointFrame> frames = source_.add(view, &used);
  if (used) {
    pending_.push_back({view.stamp,
                        header,
                        sky_points(view.labels, view.view.camera, labels_.sky_ids(), config_.sky)});
    last_used_stamp_ = view.stamp;
    ++used_since_flush_;
    ++used_;
    diagnostics_->count("images used");
  } else {
    diagnostics_->count("images without parallax");
    look_for_standstill(view.stamp);
  }
  publish(frames);
  diagnostics_->set("seconds of the last image", (ros::WallTime::now() - start).toSec());
}

void MovingCamera::look_for_standstill(double stamp) {
  ++unused_;
  if (used_ <= 1 && unused_ % kPatience == 0) {
    diagnostics_->complain(
        "no parallax",
        std::to_string(unused_) +
            " images came and none shows parallax: a camera that stands or only turns cannot "
            "measure depth. If it does move, check that tf moves it in '" +
            config_.pose.map_frame + "' at the images' stamps");
  }
  // One image alone holds no point that could wait.
  if (used_since_flush_ > 1 && stamp - last_used_stamp_ > config_.flush_after_s) {
    flush();
  }
}

void MovingCamera::flush() {
  publish(source_.finish());
  publish_sky_before(std::numeric_limits<double>::infinity());
  used_since_flush_ = 0;
}

void MovingCamera::flush_if_idle() {
  if (is_flushed_ || jobs_.size() > 0 ||
      (ros::WallTime::now() - last_image_).toSec() < config_.flush_after_s) {
    return;
  }
  is_flushed_ = jobs_.post([this] { flush(); });
}

void MovingCamera::publish(const std::vector<PointFrame>& frames) {
  for (const PointFrame& frame : frames) {
    publish_sky_before(frame.stamp);
    if (pending_.empty() || pending_.front().stamp != frame.stamp) {
      continue;  // an image from before a jump in time
    }
    Pending image = std::move(pending_.front());
    pending_.pop_front();
    std::vector<LabeledPoint> points = frame.points;
    points.insert(points.end(), image.sky.begin(), image.sky.end());
    points_pub_.publish(cloud_from_points(points, image.header));
    diagnostics_->count("clouds published");
    diagnostics_->count("points published", frame.points.size());
    diagnostics_->count("rays toward the sky", image.sky.size());
  }
}

void MovingCamera::publish_sky_before(double stamp) {
  while (!pending_.empty() && pending_.front().stamp < stamp) {
    const Pending& image = pending_.front();
    if (!image.sky.empty()) {
      points_pub_.publish(cloud_from_points(image.sky, image.header));
      diagnostics_->count("rays toward the sky", image.sky.size());
    }
    diagnostics_->count("images without a point");
    pending_.pop_front();
  }
}

void MovingCamera::refresh_diagnostics() {
  images_.refresh_diagnostics();
  diagnostics_->set("frames waiting for their transform", static_cast<double>(transforms_.size()));
  diagnostics_->set("images waiting for the worker", static_cast<double>(jobs_.size()));
}

}  // namespace facet_mapping
