// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_source.h"

#include <utility>

#include <ros/names.h>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 100;  // deltas, which must not be lost
constexpr std::size_t kMaxKept = 100;      // messages; a full mesh replaces them anyway
constexpr std::chrono::seconds kSilence(1);
constexpr std::chrono::seconds kPatience(30);  // for an answer of get_mesh

}  // namespace

std::string name_beside(const std::string& topic, const std::string& name) {
  return ros::names::append(ros::names::parentNamespace(topic), name);
}

MeshSource::MeshSource(const ros::NodeHandle& nh)
    : nh_(nh),
      inbox_(std::make_shared<Inbox>()),
      get_mesh_(std::make_unique<ServiceCaller<GetMesh>>()) {}

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
  get_mesh_ =
      std::make_unique<ServiceCaller<GetMesh>>();  // an answer under way is no longer wanted
  kept_.clear();
  silent_since_.reset();
  has_asked_newly_ = false;
  messages_ = 0;
  gaps_ = 0;
  has_palette_ = false;
  problem_.clear();
  topic_.clear();
}

/// Another subscriber of the same process may have the connection already: then the full mesh of a
/// newcomer does not come.
void MeshSource::ask_if_nothing_comes(const ChunkStore& store) {
  if (has_asked_newly_ || store.has_mesh() || publishers() == 0) {
    silent_since_.reset();
    return;
  }
  if (!silent_since_) {
    silent_since_ = Clock::now();
  } else if (Clock::now() - *silent_since_ > kSilence) {
    has_asked_newly_ = true;
    ask_for_full();
  }
}

void MeshSource::give_up_waiting() {
  if (get_mesh_->is_running() && Clock::now() - asked_ > kPatience) {
    get_mesh_->break_off();
  }
}

void MeshSource::ask_for_full() {
  asked_ = Clock::now();
  get_mesh_->call(name_beside(topic_, "get_mesh"), {});
}

bool MeshSource::apply(const LabeledMesh::Ptr& message, ChunkStore* store) {
  if (get_mesh_->is_running() && message->full == 0) {
    if (kept_.size() < kMaxKept) {
      kept_.push_back(message);
    }
    return false;
  }
  const ChunkStore::Result result = store->apply(std::move(*message));
  if (result == ChunkStore::Result::kGap) {
    kept_.push_back(message);
    ++gaps_;
    ask_for_full();
  }
  return result == ChunkStore::Result::kApplied;
}

bool MeshSource::take_answer(ChunkStore* store) {
  auto answer = get_mesh_->take();
  if (!answer) {
    return false;
  }
  std::vector<LabeledMesh::Ptr> kept = std::move(kept_);
  kept_.clear();
  if (!answer->problem.empty() || answer->response.status.code != Status::OK) {
    if (kept.empty()) {
      return false;  // no mesh yet, or no such service: nothing was missed
    }
    problem_ = "missed a message; subscribed anew to get the whole mesh, since " +
               (answer->problem.empty() ? answer->response.status.message : answer->problem);
    subscribe_mesh();
    return false;
  }
  problem_.clear();
  bool is_changed = store->apply(std::move(answer->response.mesh)) == ChunkStore::Result::kApplied;
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
  if (!topic_.empty() && !get_mesh_->is_running()) {
    ask_if_nothing_comes(*store);
  }
  give_up_waiting();
  return news;
}

}  // namespace facet_mapping
