// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_source.h"

#include <chrono>
#include <utility>

#include <boost/make_shared.hpp>
#include <facet_mapping/GetMesh.h>
#include <ros/names.h>
#include <ros/service.h>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 100;  // deltas, which must not be lost
constexpr std::size_t kMaxKept = 1000;     // messages; a full mesh replaces them anyway

/// Null if the service does not answer.
LabeledMesh::Ptr call_get_mesh(const std::string& service) {
  GetMesh call;
  if (!ros::service::exists(service, false) || !ros::service::call(service, call) ||
      call.response.status.code != Status::OK) {
    return nullptr;
  }
  return boost::make_shared<LabeledMesh>(std::move(call.response.mesh));
}

}  // namespace

std::string name_beside(const std::string& topic, const std::string& name) {
  return ros::names::append(ros::names::parentNamespace(topic), name);
}

MeshSource::MeshSource(const ros::NodeHandle& nh) : nh_(nh), inbox_(std::make_shared<Inbox>()) {}

void MeshSource::subscribe(const std::string& mesh_topic) {
  unsubscribe();
  if (mesh_topic.empty()) {
    return;
  }
  topic_ = nh_.resolveName(mesh_topic);
  subscribe_mesh();
  const auto take_palette = [inbox = inbox_](const ClassPalette::ConstPtr& palette) {
    const std::lock_guard<std::mutex> lock(inbox->mutex);
    inbox->palette = palette;
  };
  palette_sub_ = nh_.subscribe<ClassPalette>(name_beside(topic_, "palette"), 1, take_palette);
}

void MeshSource::subscribe_mesh() {
  const auto take_mesh = [inbox = inbox_](const LabeledMesh::Ptr& message) {
    const std::lock_guard<std::mutex> lock(inbox->mutex);
    inbox->meshes.push_back(message);
  };
  mesh_sub_.shutdown();
  mesh_sub_ = nh_.subscribe<LabeledMesh, const LabeledMesh::Ptr&>(topic_, kQueueSize, take_mesh);
}

void MeshSource::unsubscribe() {
  mesh_sub_.shutdown();
  palette_sub_.shutdown();
  inbox_ = std::make_shared<Inbox>();  // a callback still under way fills the old one
  kept_.clear();
  messages_ = 0;
  gaps_ = 0;
  has_palette_ = false;
  problem_.clear();
  topic_.clear();
}

void MeshSource::ask_for_full() {
  ++gaps_;
  answer_ = std::async(std::launch::async, call_get_mesh, name_beside(topic_, "get_mesh"));
}

bool MeshSource::apply(const LabeledMesh::Ptr& message, ChunkStore* store) {
  if (answer_.valid() && message->full == 0) {
    if (kept_.size() < kMaxKept) {
      kept_.push_back(message);
    }
    return false;
  }
  const ChunkStore::Result result = store->apply(std::move(*message));
  if (result == ChunkStore::Result::kGap) {
    kept_.push_back(message);
    ask_for_full();
  }
  return result == ChunkStore::Result::kApplied;
}

bool MeshSource::take_answer(ChunkStore* store) {
  if (!answer_.valid() || answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return false;
  }
  const LabeledMesh::Ptr full = answer_.get();
  std::vector<LabeledMesh::Ptr> kept = std::move(kept_);
  kept_.clear();
  if (!full || topic_.empty()) {
    problem_ = "missed a message, and " + name_beside(topic_, "get_mesh") +
               " does not answer: subscribed anew to get the whole mesh";
    if (!topic_.empty()) {
      subscribe_mesh();
    }
    return false;
  }
  problem_.clear();
  bool is_changed = store->apply(std::move(*full)) == ChunkStore::Result::kApplied;
  for (const LabeledMesh::Ptr& message : kept) {
    is_changed |= apply(message, store);
  }
  return is_changed;
}

bool MeshSource::take_messages(ChunkStore* store) {
  std::vector<LabeledMesh::Ptr> messages;
  {
    const std::lock_guard<std::mutex> lock(inbox_->mutex);
    messages.swap(inbox_->meshes);
  }
  bool is_changed = false;
  for (LabeledMesh::Ptr& message : messages) {
    ++messages_;
    if (message->full != 0) {
      problem_.clear();
    }
    is_changed |= apply(message, store);
    message.reset();
  }
  return is_changed;
}

MeshSource::News MeshSource::poll(ChunkStore* store, ClassTable* classes) {
  News news;
  ClassPalette::ConstPtr palette;
  {
    const std::lock_guard<std::mutex> lock(inbox_->mutex);
    palette.swap(inbox_->palette);
  }
  if (palette) {
    classes->set_palette(*palette);
    has_palette_ = true;
    news.palette = true;
  }
  news.mesh = take_answer(store);
  news.mesh |= take_messages(store);
  return news;
}

}  // namespace facet_mapping
