// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine_node.h"

#include <utility>

#include <ros/names.h>
#include <ros/service.h>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 1000;  // one small message per iteration
constexpr std::chrono::seconds kLookInterval(2);

}  // namespace

RefineNode::RefineNode(ros::CallbackQueueInterface* window_queue, OnProgress on_progress)
    : on_progress_(std::move(on_progress)) {
  nh_.setCallbackQueue(window_queue);
}

bool RefineNode::set_name(const std::string& name) {
  std::string resolved;
  try {
    resolved = name.empty() ? "" : nh_.resolveName(name);
  } catch (const ros::InvalidNameException&) {
    // no name
  }
  if (resolved == name_ && presence_ != Presence::kNoName) {
    return false;
  }
  progress_sub_.shutdown();
  look_.forget();
  next_look_ = {};
  name_ = resolved;
  presence_ = name_.empty() ? Presence::kNoName : Presence::kLooking;
  if (!name_.empty()) {
    const auto take = [this](const RefineProgress::ConstPtr& progress) { on_progress_(*progress); };
    progress_sub_ = nh_.subscribe<RefineProgress>(service("progress"), kQueueSize, take);
  }
  return true;
}

std::string RefineNode::service(const std::string& private_name) const {
  return ros::names::append(name_, private_name);
}

void RefineNode::poll() {
  if (name_.empty()) {
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (const std::optional<bool> is_there = look_.take()) {
    presence_ = *is_there ? Presence::kThere : Presence::kMissing;
    next_look_ = now + kLookInterval;
  }
  if (!look_.is_running() && now >= next_look_) {
    look_.start([service = service("refine")] { return ros::service::exists(service, false); });
  }
}

}  // namespace facet_mapping
