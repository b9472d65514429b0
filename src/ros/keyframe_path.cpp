// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/keyframe_path.h"

#include <algorithm>
#include <utility>

#include <ros/single_subscriber_publisher.h>
#include <tf2_eigen/tf2_eigen.h>

namespace facet_mapping {
namespace {

using Lock = std::lock_guard<std::recursive_mutex>;

}  // namespace

nav_msgs::Path path_message(const std::map<KeyframeId, Keyframe>& keyframes,
                            const std::string& map_frame) {
  nav_msgs::Path path;
  path.header.frame_id = map_frame;
  for (const auto& [id, keyframe] : keyframes) {
    geometry_msgs::PoseStamped pose;
    pose.header.seq = id;
    pose.header.frame_id = map_frame;
    pose.header.stamp = ros::Time(std::max(0.0, keyframe.stamp));
    pose.pose = tf2::toMsg(keyframe.world_from_sensor);
    path.header.stamp = std::max(path.header.stamp, pose.header.stamp);
    path.poses.push_back(pose);
  }
  return path;
}

KeyframePath::KeyframePath(ros::NodeHandle private_nh, const std::string& map_frame)
    : map_frame_(map_frame), keyframes_(std::make_shared<const std::map<KeyframeId, Keyframe>>()) {
  const Lock lock(mutex_);
  publisher_ = private_nh.advertise<nav_msgs::Path>(
      "keyframes", 1, [this](const ros::SingleSubscriberPublisher& subscriber) {
        const Lock inner(mutex_);
        subscriber.publish(path_message(*keyframes_, map_frame_));
      });
}

void KeyframePath::publish(KeyframesPtr keyframes) {
  const Lock lock(mutex_);
  keyframes_ = std::move(keyframes);
  if (publisher_.getNumSubscribers() > 0) {
    publisher_.publish(path_message(*keyframes_, map_frame_));
  }
}

}  // namespace facet_mapping
