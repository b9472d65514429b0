// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/labeled_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
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
  if (config.frozen_beyond_m != 0.0 && !(config.frozen_beyond_m >= config.max_range_m)) {
    throw std::invalid_argument(
        "map: frozen_beyond_m must be 0 (never) or at least max_range_m, since points keep coming "
        "from within that range");
  }
  if (!(config.memory_budget_mb >= 0.0)) {
    throw std::invalid_argument("map: memory_budget_mb must be 0 (no limit) or positive");
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
  const ClassInfo* info = point.label == kUnlabelled ? nullptr : labels_.find(point.label);
  const bool is_sky = info != nullptr && info->sky;
  const double range = point.position.cast<double>().norm();
  if (range < config_.min_range_m || (range > reach() && !is_sky)) {
    ++report->out_of_range;
    return false;
  }
  ray->label = point.label;
  ray->sigma = std::isfinite(point.sigma) && point.sigma > 0.0F ? point.sigma : 0.0F;
  if (point.label == kUnlabelled) {
    return true;
  }
  if (info == nullptr) {
    ++report->unknown_label;
    ray->label = kUnlabelled;
    return true;
  }
  if (info->ignore) {
    ray->label = kUnlabelled;
  }
  ray->open = is_sky;
  if (info->dynamic && config_.dynamic == DynamicPolicy::kCarve) {
    ++report->dynamic_carving;
    ray->open = true;
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
  CarvingFrame rays = carving_frame(frame, &report);
  report.used = rays.rays.size();
  const auto id = static_cast<KeyframeId>(keyframe_count_++);
  held_[id] = {frame, sensor, 0};
  pending_.emplace_back(id, std::move(rays));
  newest_position_ = frame.world_from_sensor.translation();
  last_stamp_ = frame.stamp;
  return report;
}

CarvingFrame LabeledMap::carving_frame(const PointFrame& frame, FrameReport* report) const {
  CarvingFrame rays;
  rays.center = frame.world_from_sensor.translation();
  rays.rays.reserve(frame.points.size());
  for (const LabeledPoint& point : frame.points) {
    CarvingFrame::Ray ray;
    if (admit(point, report, &ray)) {
      Eigen::Vector3d position = point.position.cast<double>();
      if (ray.open && position.norm() > reach()) {
        position *= reach() / position.norm();  // toward the sky there is no end
      }
      ray.point = frame.world_from_sensor * position;
      rays.rays.push_back(ray);
    }
  }
  return rays;
}

bool LabeledMap::move(KeyframeId id, const Eigen::Isometry3d& world_from_sensor) {
  if (!is_rigid(world_from_sensor)) {
    throw std::invalid_argument("map: the new pose of keyframe " + std::to_string(id) +
                                " is not a rigid transform");
  }
  if (held_.count(id) == 0) {
    return false;
  }
  moves_[id] = world_from_sensor;
  return true;
}

bool LabeledMap::update() {
  if (pending() == 0) {
    return false;
  }
  integrate();
  surface_ = carver_.extract_surface();
  obey_budget();
  freeze();
  return true;
}

void LabeledMap::integrate() {
  // What the last update froze is with its owner by now.
  forget();
  std::vector<FrameId> removed;
  for (const auto& [id, pose] : moves_) {
    Held& held = held_.at(id);
    held.frame.world_from_sensor = pose;
    FrameReport ignored;  // was told when the frame came
    CarvingFrame moved = carving_frame(held.frame, &ignored);
    const auto waits = std::find_if(
        pending_.begin(), pending_.end(), [&](const auto& frame) { return frame.first == id; });
    if (waits != pending_.end()) {
      waits->second = std::move(moved);
    } else {
      removed.push_back(held.carving_id);
      pending_.emplace_back(id, std::move(moved));
    }
  }
  moves_.clear();
  std::vector<KeyframeId> keyframes;
  std::vector<CarvingFrame> added;
  for (auto& [id, frame] : pending_) {
    keyframes.push_back(id);
    added.push_back(std::move(frame));
  }
  pending_.clear();
  const std::vector<FrameId> ids = carver_.update(removed, added);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    held_.at(keyframes[k]).carving_id = ids[k];
  }
}

// Cells near what is dropped change their shape, hence a margin. Somewhat more may go than came, so
// that the work is spread over the updates and still gets done.
void LabeledMap::forget() {
  constexpr std::size_t kAtLeast = 1000;
  const std::size_t vertices = carver_.stats().vertices;
  const std::size_t came = vertices - std::min(vertices, vertices_left_);
  if (std::isfinite(freeze_line_.radius_m)) {
    const double margin =
        2.0 * config_.carving.steiner_spacing_m + config_.carving.max_facet_edge_m;
    const std::size_t most = range_scale_ < 1.0 ? vertices : 2 * came + kAtLeast;
    carver_.forget_beyond(freeze_line_.center, freeze_line_.radius_m + margin, most);
  }
  vertices_left_ = carver_.stats().vertices;
}

void LabeledMap::freeze() {
  if (config_.frozen_beyond_m <= 0.0 && config_.memory_budget_mb <= 0.0) {
    return;
  }
  for (auto held = held_.begin(); held != held_.end();) {
    held = carver_.holds(held->second.carving_id) ? std::next(held) : held_.erase(held);
  }
  const double radius =
      config_.frozen_beyond_m > 0.0 ? config_.frozen_beyond_m : 2.0 * config_.max_range_m;
  const bool is_limited = config_.frozen_beyond_m > 0.0 || range_scale_ < 1.0;
  if (is_limited) {
    freeze_line_ = {newest_position_, range_scale_ * radius};
  }
}

// What the map holds grows with its ranges, so they follow the share of the budget that is in use.
void LabeledMap::obey_budget() {
  constexpr double kFull = 0.85;  // of the budget: one more update has to fit
  constexpr double kRoomy = 0.7;
  constexpr double kLeastStep = 0.6;
  constexpr double kRecovery = 1.05;
  constexpr double kLeast = 0.05;
  if (config_.memory_budget_mb <= 0.0) {
    return;
  }
  const double used = static_cast<double>(bytes() - carver_.bytes_unused());
  const double share = used / (config_.memory_budget_mb * 1024.0 * 1024.0);
  if (share > kFull) {
    range_scale_ = std::max(kLeast, range_scale_ * std::max(kLeastStep, kFull / share));
  } else if (share < kRoomy) {
    range_scale_ = std::min(1.0, range_scale_ * kRecovery);
  }
}

std::map<KeyframeId, Keyframe> LabeledMap::movable_keyframes() const {
  std::map<KeyframeId, Keyframe> keyframes;
  for (const auto& [id, held] : held_) {
    keyframes[id] = {held.frame.stamp, held.sensor, held.frame.world_from_sensor};
  }
  return keyframes;
}

std::size_t LabeledMap::bytes() const {
  std::size_t bytes = carver_.bytes() + surface_.bytes();
  for (const auto& [id, held] : held_) {
    bytes += sizeof(Held) + held.frame.points.capacity() * sizeof(LabeledPoint);
  }
  return bytes;
}

void LabeledMap::reset() {
  carver_ = SpaceCarver(config_.carving);
  surface_ = {};
  held_.clear();
  pending_.clear();
  moves_.clear();
  last_pose_.clear();
  freeze_line_ = {};
  vertices_left_ = 0;
  range_scale_ = 1.0;
  keyframe_count_ = 0;
  last_stamp_ = 0.0;
}

}  // namespace facet_mapping
