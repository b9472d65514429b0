// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/labeled_map.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace facet_mapping {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

void validate(const MapConfig& config) {
  if (!(config.min_range_m >= 0.0) || !(config.max_range_m > config.min_range_m)) {
    throw std::invalid_argument("map: ranges must satisfy 0 <= min_range_m < max_range_m");
  }
  if (!(config.keyframe_translation_m >= 0.0) || !(config.keyframe_rotation_deg >= 0.0)) {
    throw std::invalid_argument(
        "map: keyframe_translation_m and keyframe_rotation_deg must be >= 0");
  }
}

}  // namespace

LabeledMap::LabeledMap(LabelSet labels, const MapConfig& config)
    : labels_(std::move(labels)), config_(config), carver_(config.carving) {
  validate(config);
}

bool LabeledMap::is_keyframe(const PointFrame& frame, const std::string& sensor) {
  const auto last = last_pose_.find(sensor);
  if (last != last_pose_.end()) {
    const Eigen::Isometry3d motion =
        last->second.inverse(Eigen::Isometry) * frame.world_from_sensor;
    const double angle = Eigen::AngleAxisd(motion.linear()).angle() * kDegreesPerRadian;
    if (motion.translation().norm() < config_.keyframe_translation_m &&
        angle < config_.keyframe_rotation_deg) {
      return false;
    }
  }
  last_pose_[sensor] = frame.world_from_sensor;
  return true;
}

bool LabeledMap::admit(const LabeledPoint& point,
                       FrameReport* report,
                       CarvingFrame::Ray* ray) const {
  if (!point.position.allFinite()) {
    ++report->not_finite;
    return false;
  }
  const double range = point.position.cast<double>().norm();
  if (range < config_.min_range_m || range > config_.max_range_m) {
    ++report->out_of_range;
    return false;
  }
  ray->label = point.label;
  ray->sigma = std::isfinite(point.sigma) && point.sigma > 0.0F ? point.sigma : 0.0F;
  if (point.label == kUnlabelled) {
    return true;
  }
  const ClassInfo* info = labels_.find(point.label);
  if (info == nullptr) {
    ++report->unknown_label;
    ray->label = kUnlabelled;
    return true;
  }
  if (info->ignore) {
    ray->label = kUnlabelled;
  }
  if (info->dynamic && config_.dynamic == DynamicPolicy::kDrop) {
    ++report->dynamic_dropped;
    return false;
  }
  return true;
}

FrameReport LabeledMap::add(const PointFrame& frame, const std::string& sensor) {
  if (!is_rigid(frame.world_from_sensor)) {
    throw std::invalid_argument("map: the pose of a frame is not a rigid transform; check tf");
  }
  FrameReport report;
  report.keyframe = is_keyframe(frame, sensor);
  if (!report.keyframe) {
    return report;
  }
  CarvingFrame carving_frame;
  carving_frame.center = frame.world_from_sensor.translation();
  carving_frame.rays.reserve(frame.points.size());
  for (const LabeledPoint& point : frame.points) {
    CarvingFrame::Ray ray;
    if (admit(point, &report, &ray)) {
      ray.point = frame.world_from_sensor * point.position.cast<double>();
      carving_frame.rays.push_back(ray);
    }
  }
  report.used = carving_frame.rays.size();
  pending_.push_back(std::move(carving_frame));
  ++keyframes_;
  last_stamp_ = frame.stamp;
  return report;
}

bool LabeledMap::update() {
  if (pending_.empty()) {
    return false;
  }
  const std::vector<CarvingFrame> batch = std::exchange(pending_, {});
  carver_.insert(batch);
  surface_ = carver_.extract_surface();
  return true;
}

void LabeledMap::reset() {
  carver_ = SpaceCarver(config_.carving);
  surface_ = {};
  pending_.clear();
  last_pose_.clear();
  keyframes_ = 0;
  last_stamp_ = 0.0;
}

}  // namespace facet_mapping
