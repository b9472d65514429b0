// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/transform_queue.h"

#include <utility>

#include <tf2_eigen/tf2_eigen.h>

namespace facet_mapping {
namespace {

constexpr double kPollPeriodS = 0.05;  // only while something waits

}  // namespace

std::string without_slash(const std::string& frame_id) {
  return !frame_id.empty() && frame_id.front() == '/' ? frame_id.substr(1) : frame_id;
}

TransformQueue::TransformQueue(const ros::NodeHandle& nh,
                               const tf2_ros::Buffer* buffer,
                               const PoseInput& config,
                               NodeDiagnostics* diagnostics)
    : buffer_(buffer), config_(config), diagnostics_(diagnostics) {
  config_.map_frame = without_slash(config.map_frame);
  timer_ = nh.createWallTimer(
      ros::WallDuration(kPollPeriodS),
      [this](const ros::WallTimerEvent&) { poll(); },
      false,
      false);
}

void TransformQueue::push(const std::string& frame_id, const ros::Time& stamp, Ready ready) {
  Waiting item{without_slash(frame_id), stamp, ros::WallTime::now(), std::move(ready)};
  if (item.frame_id.empty()) {
    diagnostics_->complain("no frame_id",
                           "a message has no frame_id in its header, so that its pose cannot be "
                           "looked up; set it in the driver");
    return;
  }
  std::string error;
  if (waiting_.empty() && try_resolve(item, &error)) {
    return;
  }
  if (waiting_.size() >= static_cast<std::size_t>(config_.tf_queue_size)) {
    diagnostics_->complain("tf queue full",
                           std::to_string(waiting_.size()) +
                               " frames wait for their transform already, the oldest is dropped; "
                               "is the node that publishes tf running?");
    waiting_.pop_front();
  }
  waiting_.push_back(std::move(item));
  timer_.start();
}

void TransformQueue::clear() {
  waiting_.clear();
  timer_.stop();
}

bool TransformQueue::try_resolve(const Waiting& item, std::string* error) {
  Eigen::Isometry3d pose;
  try {
    pose = tf2::transformToEigen(
        buffer_->lookupTransform(config_.map_frame, item.frame_id, item.stamp));
  } catch (const tf2::TransformException& e) {
    *error = e.what();
    return false;
  }
  if (is_rigid(pose)) {
    item.ready(pose);
  } else {
    diagnostics_->complain("bad pose",
                           "the transform from '" + item.frame_id + "' to '" + config_.map_frame +
                               "' is not finite or not rigid; check the localisation");
  }
  return true;
}

void TransformQueue::poll() {
  std::deque<Waiting> still_waiting;
  std::deque<Waiting> items;
  items.swap(waiting_);  // a callback may push or clear
  for (Waiting& item : items) {
    std::string error;
    if (try_resolve(item, &error)) {
      continue;
    }
    if ((ros::WallTime::now() - item.arrival).toSec() > config_.tf_timeout_s) {
      drop(item, error);
    } else {
      still_waiting.push_back(std::move(item));
    }
  }
  still_waiting.insert(still_waiting.end(),
                       std::make_move_iterator(waiting_.begin()),
                       std::make_move_iterator(waiting_.end()));
  waiting_.swap(still_waiting);
  if (waiting_.empty()) {
    timer_.stop();
  }
}

void TransformQueue::drop(const Waiting& item, const std::string& error) {
  diagnostics_->complain(
      "no transform",
      explain_missing_transform(
          *buffer_, config_.map_frame, item.frame_id, item.stamp, config_.tf_timeout_s, error));
}

}  // namespace facet_mapping
