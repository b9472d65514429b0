// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/pose_corrector.h"

namespace facet_mapping {
namespace {

constexpr double kStampToleranceS = 1e-3;
constexpr double kLeastMotionM = 1e-3;
constexpr double kLeastTurnRad = 0.01 / 57.29577951308232;
constexpr double kFarthestM = 1e7;  // beyond it a double says less than a nanometre

bool is_usable(const Eigen::Isometry3d& pose) {
  return is_rigid(pose) && pose.translation().norm() < kFarthestM;
}

bool is_same(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d motion = a.inverse(Eigen::Isometry) * b;
  return motion.translation().norm() < kLeastMotionM &&
         Eigen::AngleAxisd(motion.linear()).angle() < kLeastTurnRad;
}

}  // namespace

void PoseCorrector::note(const LabeledMap& map) {
  if (map.keyframes() <= next_) {
    return;
  }
  for (const auto& [id, keyframe] : map.movable_keyframes()) {
    if (id >= next_) {
      known_[id] = {keyframe.sensor, keyframe.world_from_sensor};
      by_stamp_.emplace(keyframe.stamp, id);
    }
  }
  next_ = static_cast<KeyframeId>(map.keyframes());
}

std::vector<KeyframeId> PoseCorrector::named_by(const PoseCorrection& pose) const {
  std::vector<KeyframeId> ids;
  if (pose.id) {
    if (known_.count(*pose.id) > 0) {
      ids.push_back(*pose.id);
    }
    return ids;
  }
  const auto end = by_stamp_.upper_bound(pose.stamp + kStampToleranceS);
  for (auto at = by_stamp_.lower_bound(pose.stamp - kStampToleranceS); at != end; ++at) {
    ids.push_back(at->second);
  }
  return ids;
}

CorrectionReport PoseCorrector::apply(const PoseCorrections& corrections, LabeledMap* map) {
  note(*map);
  CorrectionReport report;
  for (const PoseCorrection& pose : corrections.poses) {
    if (!is_usable(pose.world_from_frame)) {
      ++report.not_rigid;
      continue;
    }
    const std::vector<KeyframeId> ids = named_by(pose);
    if (ids.empty()) {
      ++report.unknown;
      report.unknown_stamp = pose.stamp;
    }
    if (ids.size() > 1 && corrections.of_sensor) {
      ++report.ambiguous;
      continue;
    }
    for (const KeyframeId id : ids) {
      const auto sensor = corrections.frame_from_sensor.find(known_.at(id).sensor);
      if (corrections.of_sensor) {
        move(id, pose.world_from_frame, map, &report);
      } else if (sensor == corrections.frame_from_sensor.end()) {
        ++report.not_attached;
      } else {
        move(id, pose.world_from_frame * sensor->second, map, &report);
      }
    }
  }
  return report;
}

void PoseCorrector::move(KeyframeId id,
                         const Eigen::Isometry3d& world_from_sensor,
                         LabeledMap* map,
                         CorrectionReport* report) {
  Known& known = known_.at(id);
  if (is_same(known.world_from_sensor, world_from_sensor)) {
    ++report->unchanged;
  } else if (map->move(id, world_from_sensor)) {
    known.world_from_sensor = world_from_sensor;
    ++report->moved;
  } else {
    ++report->frozen;
  }
}

std::size_t PoseCorrector::bytes() const {
  constexpr std::size_t kTreeNodes = 256;  // of both maps, on the heap
  return kTreeNodes * known_.size();
}

void PoseCorrector::clear() {
  known_.clear();
  by_stamp_.clear();
  next_ = 0;
}

}  // namespace facet_mapping
