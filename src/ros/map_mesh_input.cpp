// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/map_mesh_input.h"

#include <stdexcept>
#include <utility>

#include <facet_mapping/GetMesh.h>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 100;  // deltas, which must not be lost
constexpr double kFirstMeshWaitS = 3.0;

}  // namespace

MapMeshInput::MapMeshInput(ros::NodeHandle nh,
                           const std::string& map_frame,
                           NodeDiagnostics* diagnostics,
                           std::function<void()> on_update)
    : map_frame_(map_frame),
      diagnostics_(diagnostics),
      on_update_(std::move(on_update)),
      topic_(nh.resolveName("mesh")),
      client_(nh.serviceClient<GetMesh>("get_mesh")),
      jobs_(1, [this](const std::string& error) {
        diagnostics_->complain("unusable mesh", "the full mesh: " + error);
      }) {
  diagnostics_->expect_input(topic_);
  subscriber_ = nh.subscribe<LabeledMesh>(
      "mesh", kQueueSize, [this](const LabeledMeshConstPtr& message) { receive(message); });
  first_timer_ = nh.createWallTimer(ros::WallDuration(kFirstMeshWaitS),
                                    [this](const ros::WallTimerEvent&) { request_first(); });
}

void MapMeshInput::request_first() {
  // In a nodelet manager that subscribed before, roscpp shares the connection: no full mesh comes.
  const std::lock_guard<std::mutex> lock(mutex_);
  if (receiver_.has_mesh()) {
    first_timer_.stop();
  } else if (subscriber_.getNumPublishers() > 0) {
    jobs_.post([this] { request_full(); });
  }
}

void MapMeshInput::receive(const LabeledMeshConstPtr& message) {
  diagnostics_->count_input(topic_);
  try {
    if (apply(*message) == MeshReceiver::Result::kGap) {
      diagnostics_->count("mesh messages missed");
      jobs_.post([this] { request_full(); });
    }
  } catch (const std::invalid_argument& e) {
    diagnostics_->complain("unusable mesh", "'" + topic_ + "': " + e.what());
  }
}

MeshReceiver::Result MapMeshInput::apply(const LabeledMesh& message) {
  if (message.header.frame_id != map_frame_) {
    throw std::invalid_argument("the mesh is in frame '" + message.header.frame_id +
                                "', but map_frame is '" + map_frame_ +
                                "'; give both nodes the same map_frame");
  }
  MeshReceiver::Result result{};
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    result = receiver_.apply(message);
    if (result == MeshReceiver::Result::kApplied) {
      cache_.reset();
    }
  }
  if (result == MeshReceiver::Result::kApplied) {
    on_update_();
  }
  return result;
}

void MapMeshInput::request_full() {
  GetMesh service;
  if (!client_.call(service)) {
    diagnostics_->complain("get_mesh failed",
                           "a message on '" + topic_ + "' was missed and '" + client_.getService() +
                               "' does not answer; remap get_mesh to that of the mapper");
  } else if (service.response.status.code == Status::OK) {
    apply(service.response.mesh);
  }
}

MeshStatePtr MapMeshInput::mesh() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!cache_ && receiver_.has_mesh()) {
    auto state = std::make_shared<MeshState>();
    state->mesh = receiver_.mesh();
    state->stamp = receiver_.stamp();
    cache_ = std::move(state);
  }
  return cache_;
}

}  // namespace facet_mapping
