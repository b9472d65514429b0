// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A refine node as seen from the window: whether it is there, its services, its progress.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "background_job.h"
#include "service_caller.h"
#include <facet_mapping/CancelRefine.h>
#include <facet_mapping/Refine.h>
#include <facet_mapping/RefineProgress.h>
#include <facet_mapping/SaveMesh.h>
#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>

namespace facet_mapping {

/// Nothing here waits for the node. All functions are for the window's thread.
class RefineNode {
 public:
  enum class Presence { kNoName, kLooking, kThere, kMissing };
  using OnProgress = std::function<void(const RefineProgress&)>;

  /// `window_queue`: that whose callbacks run in the window's thread; so does `on_progress`.
  RefineNode(ros::CallbackQueueInterface* window_queue, OnProgress on_progress);

  /// Looks for another node from now on; calls under way go on. A name that cannot be one leaves
  /// no node. False if that is the node already.
  bool set_name(const std::string& name);
  const std::string& name() const { return name_; }
  /// The whole name of one of its services.
  std::string service(const std::string& private_name) const;

  /// Call it often: looks once in a while whether the node is there.
  void poll();
  Presence presence() const { return presence_; }

  ServiceCaller<Refine> refine;
  ServiceCaller<CancelRefine> cancel;
  ServiceCaller<SaveMesh> save;

 private:
  ros::NodeHandle nh_;
  OnProgress on_progress_;
  std::string name_;
  ros::Subscriber progress_sub_;
  BackgroundJob<bool> look_;
  std::chrono::steady_clock::time_point next_look_;
  Presence presence_ = Presence::kNoName;
};

}  // namespace facet_mapping
