// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A node's mesh on its topics: ~mesh (chunks), ~mesh_marker, ~mesh_points, ~palette.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <facet_mapping/LabeledMesh.h>
#include <ros/node_handle.h>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/ros/node_config.h"

namespace facet_mapping {

/// One state of a node's mesh, in the map frame. Shared and never changed after it was published.
struct MeshState {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_ids;  ///< one per vertex, or empty for 0, 1, 2, ...
  ros::Time stamp;                        ///< of the newest data in it
};
using MeshStatePtr = std::shared_ptr<const MeshState>;

/// Thread-safe. Everything is lazy: without subscribers nothing is cut, converted or sent.
class MeshPublisher {
 public:
  MeshPublisher(ros::NodeHandle private_nh,
                const std::string& frame_id,
                const MeshOutput& config,
                const LabelSet& labels,
                const std::string& label_source);

  /// Takes a new state: subscribers get the chunks that changed, with the next sequence number.
  void publish(MeshStatePtr state);
  /// Drops the mesh and begins a new map_id: subscribers get an empty full mesh.
  void reset(const ros::Time& stamp);

  /// The present state; null before the first and after a reset.
  MeshStatePtr current() const;
  std::uint32_t sequence() const;
  std::string map_id() const;
  const std::string& frame_id() const { return frame_id_; }
  const LabelSet& labels() const { return labels_; }

  /// The whole present mesh, as a new subscriber gets it.
  LabeledMesh full_message();
  /// Any mesh as a message that no delta applies to (map_id empty).
  LabeledMesh detached_message(const TriangleMesh& mesh, const ros::Time& stamp) const;

 private:
  void advertise(ros::NodeHandle private_nh);
  void on_mesh_subscriber(const ros::SingleSubscriberPublisher& subscriber);
  void on_marker_subscriber(const ros::SingleSubscriberPublisher& subscriber);
  void on_points_subscriber(const ros::SingleSubscriberPublisher& subscriber);
  std_msgs::Header header() const;
  LabeledMesh envelope() const;
  LabeledMesh full_message_locked();
  void refresh_chunks_locked();
  void publish_displays_locked();
  void new_map_id();

  std::string frame_id_;
  MeshOutput config_;
  LabelSet labels_;
  mutable std::recursive_mutex mutex_;  // a subscriber's callback may run inside advertise()
  MeshStatePtr state_;
  ChunkedMesh chunks_;
  bool chunks_stale_ = false;  // chunks_ is older than state_
  std::string map_id_;
  std::uint32_t sequence_ = 0;
  ros::Time stamp_;
  std::set<Label> shown_;
  ros::Publisher mesh_pub_;
  ros::Publisher marker_pub_;
  ros::Publisher points_pub_;
  ros::Publisher palette_pub_;
};

}  // namespace facet_mapping
