// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/corrected_poses.h"

#include <cmath>
#include <limits>
#include <utility>

#include <tf2_eigen/tf2_eigen.h>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 10;
constexpr double kUnitTolerance = 1e-3;

std::string poses_text(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " corrected pose " : " corrected poses ");
}

}  // namespace

Eigen::Isometry3d pose_from_message(const geometry_msgs::Pose& pose) {
  const Eigen::Quaterniond q(
      pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  if (std::abs(q.norm() - 1.0) < kUnitTolerance) {
    result.linear() = q.normalized().toRotationMatrix();
  } else {
    result.linear().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

CorrectedPoses::CorrectedPoses(ros::NodeHandle nh,
                               const std::string& map_frame,
                               const std::string& corrected_frame,
                               const tf2_ros::Buffer* buffer,
                               NodeDiagnostics* diagnostics,
                               Push push)
    : map_frame_(map_frame),
      corrected_frame_(corrected_frame),
      buffer_(buffer),
      diagnostics_(diagnostics),
      push_(std::move(push)) {
  path_subscriber_ = nh.subscribe<nav_msgs::Path>(
      "keyframe_poses", kQueueSize, [this](const nav_msgs::PathConstPtr& path) {
        receive_path(*path);
      });
  array_subscriber_ = nh.subscribe<geometry_msgs::PoseArray>(
      "keyframe_pose_array", kQueueSize, [this](const geometry_msgs::PoseArrayConstPtr& array) {
        receive_array(*array);
      });
}

void CorrectedPoses::note_sensor(const std::string& sensor, const std::string& frame_id) {
  frame_of_sensor_[sensor] = frame_id;
}

bool CorrectedPoses::find_map_from(const std::string& frame_id, Eigen::Isometry3d* map_from_frame) {
  map_from_frame->setIdentity();
  if (frame_id == map_frame_) {
    return true;
  }
  try {
    *map_from_frame =
        tf2::transformToEigen(buffer_->lookupTransform(map_frame_, frame_id, ros::Time(0)));
    return true;
  } catch (const tf2::TransformException& e) {
    diagnostics_->complain("corrected poses in an unknown frame",
                           "corrected poses came in frame '" + frame_id +
                               "', which tf cannot transform to '" + map_frame_ + "': " + e.what() +
                               "; they are ignored");
    return false;
  }
}

void CorrectedPoses::receive_path(const nav_msgs::Path& path) {
  PoseCorrections corrections;
  std::string frame_id;
  Eigen::Isometry3d map_from_frame;
  bool is_known = false;
  for (const geometry_msgs::PoseStamped& pose : path.poses) {
    const std::string& own = pose.header.frame_id;
    const std::string& next = own.empty() ? path.header.frame_id : own;
    if (corrections.poses.empty() || next != frame_id) {
      is_known = find_map_from(next, &map_from_frame);
      frame_id = next;
    }
    if (is_known) {
      corrections.poses.push_back(
          {std::nullopt, pose.header.stamp.toSec(), map_from_frame * pose_from_message(pose.pose)});
    }
  }
  hand_on(std::move(corrections));
}

void CorrectedPoses::receive_array(const geometry_msgs::PoseArray& array) {
  Eigen::Isometry3d map_from_frame;
  if (!find_map_from(array.header.frame_id, &map_from_frame)) {
    return;
  }
  PoseCorrections corrections;
  for (std::size_t k = 0; k < array.poses.size(); ++k) {
    corrections.poses.push_back(
        {static_cast<KeyframeId>(k), 0.0, map_from_frame * pose_from_message(array.poses[k])});
  }
  hand_on(std::move(corrections));
}

void CorrectedPoses::hand_on(PoseCorrections corrections) {
  if (corrections.poses.empty()) {
    return;
  }
  corrections.of_sensor = corrected_frame_.empty();
  if (!corrections.of_sensor) {
    for (const auto& [sensor, frame_id] : frame_of_sensor_) {
      try {
        corrections.frame_from_sensor[sensor] = tf2::transformToEigen(
            buffer_->lookupTransform(corrected_frame_, frame_id, ros::Time(0)));
      } catch (const tf2::TransformException& e) {
        diagnostics_->complain("no transform to corrected_frame",
                               "tf knows no transform from '" + frame_id + "' to '" +
                                   corrected_frame_ + "' (corrected_frame): " + e.what());
      }
    }
  }
  diagnostics_->count("corrected poses received", corrections.poses.size());
  if (!push_(std::move(corrections))) {
    diagnostics_->complain("map too slow for corrections",
                           "corrected poses are dropped, since the map's queue is full: publish "
                           "them less often, or raise queue_size");
  }
}

void CorrectedPoses::report(const CorrectionReport& report) {
  diagnostics_->count("keyframes moved", report.moved);
  diagnostics_->count("corrected poses that change nothing", report.unchanged);
  const auto complain = [this](std::size_t count, const char* reason, const std::string& why) {
    if (count > 0) {
      diagnostics_->complain(reason, poses_text(count) + why + "; the others are applied");
    }
  };
  complain(report.unknown,
           "corrected poses of no keyframe",
           "of a message belong to no keyframe (the last has stamp " +
               std::to_string(report.unknown_stamp) +
               "): the keyframes and their exact stamps stand on ~keyframes");
  complain(report.frozen,
           "corrected poses of frozen keyframes",
           "of a message would move keyframes that are frozen: raise frozen_beyond_m or "
           "memory_budget_mib to keep them movable");
  complain(report.not_rigid,
           "corrected poses not rigid",
           "of a message are not finite or their quaternions have not length 1");
  complain(report.ambiguous,
           "corrected poses ambiguous",
           "of a message have the stamp of several sensors' keyframes: set corrected_frame to a "
           "frame that all sensors are attached to, or use keyframe_pose_array");
  complain(report.not_attached,
           "corrected poses without sensor pose",
           "of a message cannot be applied, since tf does not know where the sensor is in "
           "corrected_frame");
}

}  // namespace facet_mapping
