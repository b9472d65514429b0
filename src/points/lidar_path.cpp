// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include "rules.h"

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/lidar_motion.h"

namespace facet_mapping {
namespace {

/// The pose at `stamp` on the motion from `a` to `b`, or beyond them if it goes on as it was.
Eigen::Isometry3d between(const StampedPose& a, const StampedPose& b, double stamp) {
  const double share = (stamp - a.stamp) / (b.stamp - a.stamp);
  const Eigen::Quaterniond start(a.world_from_sensor.linear());
  const Eigen::Quaterniond end(b.world_from_sensor.linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = start.slerp(share, end).normalized().toRotationMatrix();
  pose.translation() =
      (1.0 - share) * a.world_from_sensor.translation() + share * b.world_from_sensor.translation();
  return pose;
}

bool before(double stamp, const StampedPose& pose) {
  return stamp < pose.stamp;
}

}  // namespace

SensorPath::SensorPath(std::vector<StampedPose> poses, double max_extrapolation_s, double max_gap_s)
    : poses_(std::move(poses)), max_extrapolation_s_(max_extrapolation_s), max_gap_s_(max_gap_s) {
  detail::Rules rules;
  rules.require(!poses_.empty(), "there is no pose");
  rules.require(max_extrapolation_s >= 0.0, "max_extrapolation_s must not be negative");
  rules.require(max_gap_s > 0.0, "max_gap_s must be positive");
  double way_m = 0.0;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const std::string name = "pose " + std::to_string(i);
    rules.require(is_rigid(poses_[i].world_from_sensor), name + " is not rigid and finite");
    rules.require(std::isfinite(poses_[i].stamp), name + " has no finite stamp");
    if (i > 0) {
      rules.require(poses_[i].stamp > poses_[i - 1].stamp, name + " is not later than the last");
      way_m += (poses_[i].world_from_sensor.translation() -
                poses_[i - 1].world_from_sensor.translation())
                   .norm();
    }
    ways_m_.push_back(way_m);
  }
  rules.throw_if_broken("The sensor's path is not usable: ");
}

std::optional<Eigen::Isometry3d> SensorPath::at(double stamp) const {
  if (!std::isfinite(stamp)) {
    return std::nullopt;
  }
  const auto next = std::upper_bound(poses_.begin(), poses_.end(), stamp, before);
  if (next == poses_.begin()) {
    return before_first(stamp);
  }
  const StampedPose& last = *std::prev(next);
  if (last.stamp == stamp) {
    return last.world_from_sensor;
  }
  if (next == poses_.end()) {
    return after_last(stamp);
  }
  if (next->stamp - last.stamp > max_gap_s_) {
    return std::nullopt;
  }
  return between(last, *next, stamp);
}

// The motion is taken from at least as much time as it is carried on, so that noise does not grow.
std::optional<Eigen::Isometry3d> SensorPath::before_first(double stamp) const {
  const double missing_s = first() - stamp;
  if (missing_s > max_extrapolation_s_) {
    return std::nullopt;
  }
  const auto far = std::find_if(poses_.begin() + 1, poses_.end(), [&](const StampedPose& pose) {
    return pose.stamp >= first() + missing_s;
  });
  if (far == poses_.end() || far->stamp - first() > max_gap_s_) {
    return std::nullopt;
  }
  return between(poses_.front(), *far, stamp);
}

std::optional<Eigen::Isometry3d> SensorPath::after_last(double stamp) const {
  const double missing_s = stamp - last();
  if (missing_s > max_extrapolation_s_) {
    return std::nullopt;
  }
  const auto far = std::find_if(poses_.rbegin() + 1, poses_.rend(), [&](const StampedPose& pose) {
    return pose.stamp <= last() - missing_s;
  });
  if (far == poses_.rend() || last() - far->stamp > max_gap_s_) {
    return std::nullopt;
  }
  return between(*far, poses_.back(), stamp);
}

double SensorPath::way_m(double stamp) const {
  const auto next = std::upper_bound(poses_.begin(), poses_.end(), stamp, before);
  if (next == poses_.begin()) {
    return 0.0;
  }
  const auto i = static_cast<std::size_t>(next - poses_.begin());
  if (i == poses_.size()) {
    return ways_m_.back();
  }
  const double share = (stamp - poses_[i - 1].stamp) / (poses_[i].stamp - poses_[i - 1].stamp);
  return ways_m_[i - 1] + share * (ways_m_[i] - ways_m_[i - 1]);
}

double SensorPath::stamp_at(double way_m) const {
  const auto next = std::lower_bound(ways_m_.begin(), ways_m_.end(), way_m);
  const auto i = static_cast<std::size_t>(next - ways_m_.begin());
  if (i == ways_m_.size()) {
    return last();
  }
  if (i == 0) {
    return first();
  }
  const double share = (way_m - ways_m_[i - 1]) / (ways_m_[i] - ways_m_[i - 1]);
  return poses_[i - 1].stamp + share * (poses_[i].stamp - poses_[i - 1].stamp);
}

}  // namespace facet_mapping
