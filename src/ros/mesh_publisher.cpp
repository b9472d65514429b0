// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_publisher.h"

#include <cstdio>
#include <utility>

#include <ros/single_subscriber_publisher.h>

#include "facet_mapping/ros/cloud_conversions.h"
#include "facet_mapping/ros/mesh_conversions.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kMeshQueueSize = 100;  // deltas, which must not be lost
constexpr std::uint32_t kLatestOnly = 1;
constexpr std::uint32_t kPaletteVersion = 1;  // the class list of a node never changes

using Lock = std::lock_guard<std::recursive_mutex>;

}  // namespace

MeshPublisher::MeshPublisher(ros::NodeHandle private_nh,
                             const std::string& frame_id,
                             const MeshOutput& config,
                             const LabelSet& labels,
                             const std::string& label_source)
    : frame_id_(frame_id), config_(config), labels_(labels), chunks_(config.chunk_size_m) {
  new_map_id();
  advertise(std::move(private_nh));
  ClassPalette palette = palette_message(labels_, label_source, kPaletteVersion);
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
  message.palette_version = kPaletteVersion;
  return message;
}

void MeshPublisher::publish(MeshStatePtr state) {
  const Lock lock(mutex_);
  state_ = std::move(state);
  stamp_ = state_->stamp;
  ++sequence_;
  // Whoever listens has all earlier deltas, so the chunks are only stale while nobody does.
  if (mesh_pub_.getNumSubscribers() == 0 || chunks_stale_) {
    chunks_stale_ = true;
  } else {
    const ChunkDelta delta = chunks_.update(state_->mesh, state_->vertex_ids);
    LabeledMesh message = envelope();
    for (const MeshChunk& chunk : delta.changed) {
      message.chunks.push_back(chunk_to_message(chunk));
    }
    for (const ChunkKey& key : delta.removed) {
      message.removed_keys.insert(message.removed_keys.end(), key.begin(), key.end());
    }
    mesh_pub_.publish(message);
  }
  publish_displays_locked();
}

void MeshPublisher::publish_displays_locked() {
  const TriangleMesh empty;
  const TriangleMesh& mesh = state_ ? state_->mesh : empty;
  if (marker_pub_.getNumSubscribers() > 0) {
    const auto markers = markers_from_mesh(
        mesh, labels_, header(), static_cast<std::size_t>(config_.marker_max_triangles), &shown_);
    if (!markers.markers.empty()) {
      marker_pub_.publish(markers);
    }
  }
  if (points_pub_.getNumSubscribers() > 0) {
    points_pub_.publish(cloud_from_mesh(mesh, labels_, header()));
  }
}

void MeshPublisher::reset(const ros::Time& stamp) {
  const Lock lock(mutex_);
  state_.reset();
  stamp_ = stamp;
  chunks_.clear();
  chunks_stale_ = false;
  new_map_id();
  LabeledMesh message = envelope();
  message.full = 1;
  mesh_pub_.publish(message);
  publish_displays_locked();
}

MeshStatePtr MeshPublisher::current() const {
  const Lock lock(mutex_);
  return state_;
}

std::uint32_t MeshPublisher::sequence() const {
  const Lock lock(mutex_);
  return sequence_;
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
  LabeledMesh message;
  message.header.frame_id = frame_id_;
  message.header.stamp = stamp;
  message.sequence = sequence();
  message.full = 1;
  message.palette_version = kPaletteVersion;
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
  if (!state_ || state_->mesh.empty()) {
    return;
  }
  subscriber.publish(markers_from_mesh(state_->mesh,
                                       labels_,
                                       header(),
                                       static_cast<std::size_t>(config_.marker_max_triangles),
                                       &shown_));
}

void MeshPublisher::on_points_subscriber(const ros::SingleSubscriberPublisher& subscriber) {
  const Lock lock(mutex_);
  if (state_) {
    subscriber.publish(cloud_from_mesh(state_->mesh, labels_, header()));
  }
}

}  // namespace facet_mapping
