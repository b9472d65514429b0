// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_publisher.h"

#include <cstdio>
#include <stdexcept>
#include <utility>

#include <ros/single_subscriber_publisher.h>

#include "facet_mapping/ros/cloud_conversions.h"
#include "facet_mapping/ros/mesh_conversions.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kMeshQueueSize = 100;  // deltas, which must not be lost
constexpr std::uint32_t kLatestOnly = 1;

using Lock = std::lock_guard<std::recursive_mutex>;

bool everything(const ChunkKey& /*key*/) {
  return true;
}

}  // namespace

MeshPublisher::MeshPublisher(ros::NodeHandle private_nh,
                             const std::string& frame_id,
                             const MeshOutput& config,
                             const LabelSet& labels,
                             const std::string& label_source,
                             const std::string& archive_folder,
                             std::function<void(const std::string&)> on_problem)
    : frame_id_(frame_id),
      config_(config),
      labels_(labels),
      on_problem_(std::move(on_problem)),
      chunks_(config.chunk_size_m),
      archive_(archive_folder, on_problem_) {
  new_map_id();
  advertise(std::move(private_nh));
  const Lock lock(mutex_);
  publish_palette_locked(label_source);
}

void MeshPublisher::publish_palette_locked(const std::string& label_source) {
  ClassPalette palette = palette_message(labels_, label_source, ++palette_version_);
  palette.header.stamp = ros::Time::now();
  palette_pub_.publish(palette);
}

void MeshPublisher::advertise(ros::NodeHandle private_nh) {
  const Lock lock(mutex_);
  using Subscriber = ros::SingleSubscriberPublisher;
  palette_pub_ = private_nh.advertise<ClassPalette>("palette", kLatestOnly, true);
  mesh_pub_ = private_nh.advertise<LabeledMesh>(
      "mesh", kMeshQueueSize, [this](const Subscriber& s) { on_mesh_subscriber(s); });
  marker_pub_ = private_nh.advertise<visualization_msgs::MarkerArray>(
      "mesh_marker", kLatestOnly, [this](const Subscriber& s) { on_marker_subscriber(s); });
  points_pub_ = private_nh.advertise<sensor_msgs::PointCloud2>(
      "mesh_points", kLatestOnly, [this](const Subscriber& s) { on_points_subscriber(s); });
}

void MeshPublisher::new_map_id() {
  char text[32];
  std::snprintf(
      text, sizeof(text), "%llx", static_cast<unsigned long long>(ros::WallTime::now().toNSec()));
  map_id_ = text;
  sequence_ = 0;
}

std_msgs::Header MeshPublisher::header() const {
  std_msgs::Header header;
  header.frame_id = frame_id_;
  header.stamp = stamp_;
  return header;
}

LabeledMesh MeshPublisher::envelope() const {
  LabeledMesh message;
  message.header = header();
  message.map_id = map_id_;
  message.sequence = sequence_;
  message.palette_version = palette_version_;
  return message;
}

void MeshPublisher::publish(MeshStatePtr state) {
  const Lock lock(mutex_);
  state_ = std::move(state);
  stamp_ = state_->stamp;
  ++sequence_;
  in_chunks_ = in_chunks_ || state_->line.is_limited();
  // Whoever listens has all earlier deltas, so the chunks are only stale while nobody does.
  const bool has_listeners = mesh_pub_.getNumSubscribers() > 0 && !chunks_stale_;
  chunks_stale_ = !has_listeners && !in_chunks_;
  if (!chunks_stale_) {
    ChunkDelta delta = chunks_.update(state_->mesh, state_->vertex_ids, state_->line);
    if (has_listeners) {
      mesh_pub_.publish(delta_message(delta));
    }
    archive_.add(std::move(delta.frozen));
  }
  if (in_chunks_) {
    auto light = std::make_shared<MeshState>();
    light->stamp = state_->stamp;
    light->line = state_->line;
    state_ = std::move(light);
  }
  publish_displays_locked();
}

LabeledMesh MeshPublisher::delta_message(const ChunkDelta& delta) const {
  LabeledMesh message = envelope();
  for (const MeshChunk& chunk : delta.changed) {
    message.chunks.push_back(chunk_to_message(chunk));
  }
  for (const ChunkKey& key : delta.removed) {
    message.removed_keys.insert(message.removed_keys.end(), key.begin(), key.end());
  }
  return message;
}

void MeshPublisher::publish_displays_locked(visualization_msgs::MarkerArray gone) {
  if (marker_pub_.getNumSubscribers() == 0 && points_pub_.getNumSubscribers() == 0) {
    return;
  }
  const MeshStatePtr state = state_for_display_locked();
  if (marker_pub_.getNumSubscribers() > 0) {
    visualization_msgs::MarkerArray markers = markers_of_locked(state->mesh);
    markers.markers.insert(markers.markers.begin(), gone.markers.begin(), gone.markers.end());
    if (!markers.markers.empty()) {
      marker_pub_.publish(markers);
    }
  }
  if (points_pub_.getNumSubscribers() > 0) {
    points_pub_.publish(cloud_from_mesh(state->mesh, labels_, header()));
  }
}

visualization_msgs::MarkerArray MeshPublisher::markers_of_locked(const TriangleMesh& mesh) {
  return markers_from_mesh(
      mesh, labels_, header(), static_cast<std::size_t>(config_.marker_max_triangles), &shown_);
}

void MeshPublisher::forget_locked(const ros::Time& stamp) {
  state_.reset();
  stamp_ = stamp;
  chunks_.clear();
  chunks_stale_ = false;
  archive_.clear();
  in_chunks_ = false;
  new_map_id();
}

void MeshPublisher::replace(MeshStatePtr state,
                            const std::string& frame_id,
                            const LabelSet& labels,
                            const std::string& label_source) {
  const Lock lock(mutex_);
  const visualization_msgs::MarkerArray gone = markers_of_locked({});  // under their old names
  forget_locked(state->stamp);
  frame_id_ = frame_id;
  labels_ = labels;
  publish_palette_locked(label_source);
  state_ = std::move(state);
  chunks_stale_ = true;
  ++sequence_;
  if (mesh_pub_.getNumSubscribers() > 0) {
    mesh_pub_.publish(full_message_locked());
  }
  publish_displays_locked(gone);
}

void MeshPublisher::reset(const ros::Time& stamp) {
  const Lock lock(mutex_);
  forget_locked(stamp);
  LabeledMesh message = envelope();
  message.full = 1;
  mesh_pub_.publish(message);
  publish_displays_locked();
}

MeshStatePtr MeshPublisher::current() const {
  const Lock lock(mutex_);
  return complete_or_throw(everything);
}

MeshStatePtr MeshPublisher::current_within(const Eigen::AlignedBox3d& box) const {
  const Lock lock(mutex_);
  return complete_or_throw(
      [&](const ChunkKey& key) { return box.intersects(cell_of(key, config_.chunk_size_m)); });
}

MeshStatePtr MeshPublisher::complete_or_throw(const ChunkArchive::Wanted& wanted) const {
  std::string problem;
  MeshStatePtr state = state_within_locked(wanted, &problem);
  if (!problem.empty()) {
    throw std::runtime_error(problem);
  }
  return state;
}

MeshStatePtr MeshPublisher::state_for_display_locked() const {
  std::string problem;
  MeshStatePtr state = state_within_locked(everything, &problem);
  report(problem);
  return state ? state : std::make_shared<MeshState>();
}

MeshStatePtr MeshPublisher::state_within_locked(const ChunkArchive::Wanted& wanted,
                                                std::string* problem) const {
  if (!in_chunks_) {
    return state_;
  }
  const std::vector<MeshChunk> archived = archived_locked(wanted, problem);
  std::vector<const MeshChunk*> chunks;
  for (const MeshChunk& chunk : archived) {
    chunks.push_back(&chunk);
  }
  for (const auto& [key, chunk] : chunks_.chunks()) {
    if (wanted(key)) {
      chunks.push_back(&chunk);
    }
  }
  auto state = std::make_shared<MeshState>();
  state->mesh = assemble(chunks);
  state->stamp = stamp_;
  return state;
}

std::vector<MeshChunk> MeshPublisher::archived_locked(const ChunkArchive::Wanted& wanted,
                                                      std::string* problem) const {
  std::vector<MeshChunk> chunks;
  try {
    archive_.for_each(wanted, [&](const MeshChunk& chunk) { chunks.push_back(chunk); });
  } catch (const std::runtime_error& e) {
    *problem = e.what();
  }
  return chunks;
}

void MeshPublisher::report(const std::string& problem) const {
  if (!problem.empty() && on_problem_) {
    on_problem_(problem);
  }
}

std::size_t MeshPublisher::facets() const {
  const Lock lock(mutex_);
  if (!in_chunks_) {
    return state_ ? state_->mesh.triangles.size() : 0;
  }
  std::size_t facets = archive_.totals().facets;
  for (const auto& [key, chunk] : chunks_.chunks()) {
    facets += chunk.triangles.size();
  }
  return facets;
}

MeshTotals MeshPublisher::totals() const {
  const Lock lock(mutex_);
  if (!in_chunks_) {
    return state_ ? totals_of(state_->mesh) : MeshTotals();
  }
  MeshTotals totals = archive_.totals();
  for (const auto& [key, chunk] : chunks_.chunks()) {
    totals += totals_of(chunk);
  }
  return totals;
}

FrozenStats MeshPublisher::frozen() const {
  const Lock lock(mutex_);
  return {
      archive_.size(), archive_.totals().facets, archive_.unwritten(), archive_.bytes_on_disk()};
}

std::size_t MeshPublisher::bytes() const {
  const Lock lock(mutex_);
  std::size_t bytes = chunks_.bytes() + archive_.bytes();
  if (state_) {
    bytes += bytes_of(state_->mesh) + bytes_of(state_->vertex_ids);
  }
  return bytes;
}

ros::Time MeshPublisher::stamp() const {
  const Lock lock(mutex_);
  return stamp_;
}

std::uint32_t MeshPublisher::sequence() const {
  const Lock lock(mutex_);
  return sequence_;
}

std::string MeshPublisher::frame_id() const {
  const Lock lock(mutex_);
  return frame_id_;
}

LabelSet MeshPublisher::labels() const {
  const Lock lock(mutex_);
  return labels_;
}

std::string MeshPublisher::map_id() const {
  const Lock lock(mutex_);
  return map_id_;
}

void MeshPublisher::refresh_chunks_locked() {
  if (chunks_stale_ && state_) {
    chunks_.update(state_->mesh, state_->vertex_ids);
    chunks_stale_ = false;
  }
}

LabeledMesh MeshPublisher::full_message_locked() {
  LabeledMesh message = envelope();
  message.full = 1;
  if (state_) {
    refresh_chunks_locked();
    for (const auto& [key, chunk] : chunks_.chunks()) {
      message.chunks.push_back(chunk_to_message(chunk));
    }
    std::string problem;
    for (const MeshChunk& chunk : archived_locked(everything, &problem)) {
      message.chunks.push_back(chunk_to_message(chunk));
    }
    report(problem);  // the rest is better than nothing
  }
  return message;
}

LabeledMesh MeshPublisher::full_message() {
  const Lock lock(mutex_);
  return full_message_locked();
}

LabeledMesh MeshPublisher::detached_message(const TriangleMesh& mesh,
                                            const ros::Time& stamp) const {
  ChunkedMesh chunks(config_.chunk_size_m);
  chunks.update(mesh);
  const Lock lock(mutex_);
  LabeledMesh message;
  message.header.frame_id = frame_id_;
  message.header.stamp = stamp;
  message.sequence = sequence_;
  message.full = 1;
  message.palette_version = palette_version_;
  for (const auto& [key, chunk] : chunks.chunks()) {
    message.chunks.push_back(chunk_to_message(chunk));
  }
  return message;
}

void MeshPublisher::on_mesh_subscriber(const ros::SingleSubscriberPublisher& subscriber) {
  const Lock lock(mutex_);
  subscriber.publish(full_message_locked());
}

void MeshPublisher::on_marker_subscriber(const ros::SingleSubscriberPublisher& subscriber) {
  const Lock lock(mutex_);
  const MeshStatePtr state = state_for_display_locked();
  const visualization_msgs::MarkerArray markers = markers_of_locked(state->mesh);
  if (!markers.markers.empty()) {
    subscriber.publish(markers);
  }
}

void MeshPublisher::on_points_subscriber(const ros::SingleSubscriberPublisher& subscriber) {
  const Lock lock(mutex_);
  if (state_) {
    subscriber.publish(cloud_from_mesh(state_for_display_locked()->mesh, labels_, header()));
  }
}

}  // namespace facet_mapping
