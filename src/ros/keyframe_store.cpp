// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/keyframe_store.h"

#include <algorithm>
#include <utility>

namespace facet_mapping {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

std::size_t bytes_of(const LabeledView& view) {
  return view.gray.total() * view.gray.elemSize() + view.labels.total() * view.labels.elemSize();
}

}  // namespace

bool KeyframeStore::wants(const Eigen::Isometry3d& world_from_cam) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (views_.empty()) {
    return true;
  }
  const Eigen::Isometry3d motion =
      views_.back().view.world_from_cam.inverse(Eigen::Isometry) * world_from_cam;
  return motion.translation().norm() >= limits_.translation_m ||
         Eigen::AngleAxisd(motion.linear()).angle() * kDegreesPerRadian >= limits_.rotation_deg;
}

std::size_t KeyframeStore::add(LabeledView view) {
  const std::lock_guard<std::mutex> lock(mutex_);
  bytes_ += bytes_of(view);
  views_.push_back(std::move(view));
  std::size_t dropped = 0;
  // Two views are the least that a refinement can use, so they stay whatever they weigh.
  while (views_.size() > limits_.max_count || (bytes_ > limits_.max_bytes && views_.size() > 2)) {
    bytes_ -= bytes_of(views_.front());
    views_.pop_front();
    ++dropped;
  }
  return dropped;
}

std::vector<LabeledView> KeyframeStore::views() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {views_.begin(), views_.end()};
}

std::optional<LabeledView> KeyframeStore::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return views_.empty() ? std::nullopt : std::make_optional(views_.back());
}

std::size_t KeyframeStore::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return views_.size();
}

std::size_t KeyframeStore::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return bytes_;
}

std::size_t KeyframeStore::labelled() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<std::size_t>(std::count_if(
      views_.begin(), views_.end(), [](const LabeledView& view) { return !view.labels.empty(); }));
}

void KeyframeStore::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  views_.clear();
  bytes_ = 0;
}

}  // namespace facet_mapping
