// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/stamp_sync.h"

#include <utility>

namespace facet_mapping {

StampSync::StampSync(std::vector<Part> parts, double cache_s, std::size_t max_frames)
    : parts_(std::move(parts)), last_(parts_.size()), cache_s_(cache_s), max_frames_(max_frames) {
  counts_.missing.assign(parts_.size(), 0);
}

std::vector<StampedParts> StampSync::add(std::size_t part,
                                         const ros::Time& stamp,
                                         boost::shared_ptr<const void> message,
                                         const ros::WallTime& now) {
  last_[part] = stamp;
  if (done_.count(stamp) > 0) {
    ++counts_.late;
    return poll(now);
  }
  auto [entry, is_new] = frames_.try_emplace(stamp);
  Frame& frame = entry->second;
  if (is_new) {
    frame.parts.resize(parts_.size());
    frame.first = now;
  }
  frame.parts[part] = std::move(message);
  if (frame.complete.isZero() && has_required(frame)) {
    frame.complete = now;
  }
  return poll(now);
}

std::vector<StampedParts> StampSync::poll(const ros::WallTime& now) {
  std::vector<StampedParts> ready;
  for (auto entry = frames_.begin(); entry != frames_.end();) {
    Frame& frame = entry->second;
    const bool too_old = (now - frame.first).toSec() > cache_s_ || frames_.size() > max_frames_;
    const bool complete = !frame.complete.isZero();
    if (is_ready(entry->first, frame, now) || (too_old && complete)) {
      count_missing(frame);
      ready.push_back({entry->first, std::move(frame.parts)});
    } else if (too_old) {
      ++counts_.unpaired;
      count_missing(frame);
    } else {
      ++entry;
      continue;
    }
    done_[entry->first] = now;
    entry = frames_.erase(entry);
  }
  for (auto entry = done_.begin(); entry != done_.end();) {
    entry = (now - entry->second).toSec() > 2.0 * cache_s_ ? done_.erase(entry) : std::next(entry);
  }
  return ready;
}

bool StampSync::has_required(const Frame& frame) const {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (parts_[k].required && frame.parts[k] == nullptr) {
      return false;
    }
  }
  return true;
}

bool StampSync::is_ready(const ros::Time& stamp,
                         const Frame& frame,
                         const ros::WallTime& now) const {
  if (frame.complete.isZero()) {
    return false;
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const bool can_come = frame.parts[k] == nullptr && last_[k] < stamp;
    if (can_come && (now - frame.complete).toSec() < parts_[k].wait_s) {
      return false;
    }
  }
  return true;
}

void StampSync::count_missing(const Frame& frame) {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    counts_.missing[k] += frame.parts[k] == nullptr ? 1 : 0;
  }
}

void StampSync::clear() {
  frames_.clear();
  done_.clear();
  last_.assign(parts_.size(), ros::Time());
}

}  // namespace facet_mapping
