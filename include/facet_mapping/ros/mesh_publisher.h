// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A node's mesh on its topics: ~mesh (chunks), ~mesh_marker, ~mesh_points, ~palette.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <facet_mapping/LabeledMesh.h>
#include <ros/node_handle.h>
#include <visualization_msgs/MarkerArray.h>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/mapping/chunk_archive.h"
#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/mapping/mesh_totals.h"
#include "facet_mapping/ros/node_config.h"

namespace facet_mapping {

/// One state of a node's mesh, in the map frame. Shared and never changed after it was published.
struct MeshState {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_ids;  ///< one per vertex, or empty for 0, 1, 2, ...
  ros::Time stamp;                        ///< of the newest data in it
  FreezeLine line;                        ///< what lies outside is final
};
using MeshStatePtr = std::shared_ptr<const MeshState>;

/// What the publisher holds besides the chunks that still change.
struct FrozenStats {
  std::uint64_t chunks = 0;
  std::uint64_t facets = 0;
  std::uint64_t unwritten = 0;  ///< chunks in memory, since the disk did not take them
  std::uint64_t bytes_on_disk = 0;
};

/// Thread-safe. Everything is lazy: without subscribers nothing is cut, converted or sent. Once a
/// state has a freeze line, its mesh is cut at every update, and what the line leaves behind goes
/// to an archive on the disk, from which late subscribers and services get it.
class MeshPublisher {
 public:
  /// `archive_folder`: parent of the archive's folder, "" for the system's temporary folder.
  /// `on_problem` is told when the archive cannot be written or read.
  MeshPublisher(ros::NodeHandle private_nh,
                const std::string& frame_id,
                const MeshOutput& config,
                const LabelSet& labels,
                const std::string& label_source,
                const std::string& archive_folder = "",
                std::function<void(const std::string&)> on_problem = {});

  /// Takes a new state: subscribers get the chunks that changed, with the next sequence number.
  void publish(MeshStatePtr state);
  /// Drops the mesh and begins a new map_id: subscribers get an empty full mesh.
  void reset(const ros::Time& stamp);
  /// Shows another mesh, whose classes and frame may be others: the palette is published anew if
  /// they are, a new map_id begins, and all subscribers get the full mesh.
  void replace(MeshStatePtr state,
               const std::string& frame_id,
               const LabelSet& labels,
               const std::string& label_source);

  /// The present state, frozen part included; null before the first and after a reset.
  /// Throws std::runtime_error if a part cannot be read back from the archive.
  MeshStatePtr current() const;
  /// At least the facets of current() whose centroid lies in the box (map frame).
  MeshStatePtr current_within(const Eigen::AlignedBox3d& box) const;
  std::size_t facets() const;
  MeshTotals totals() const;
  FrozenStats frozen() const;
  /// Stamp of the present state; zero before the first.
  ros::Time stamp() const;
  std::size_t bytes() const;  ///< of memory held
  std::uint32_t sequence() const;
  std::string map_id() const;
  std::string frame_id() const;
  LabelSet labels() const;

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
  LabeledMesh delta_message(const ChunkDelta& delta) const;
  std::vector<MeshChunk> archived_locked(const ChunkArchive::Wanted& wanted,
                                         std::string* problem) const;
  MeshStatePtr state_within_locked(const ChunkArchive::Wanted& wanted, std::string* problem) const;
  MeshStatePtr complete_or_throw(const ChunkArchive::Wanted& wanted) const;
  void report(const std::string& problem) const;
  MeshStatePtr state_for_display_locked() const;
  void refresh_chunks_locked();
  /// `gone`: markers to delete, in the same message since only the latest is kept.
  void publish_displays_locked(visualization_msgs::MarkerArray gone = {});
  visualization_msgs::MarkerArray markers_of_locked(const TriangleMesh& mesh);
  void publish_palette_locked(const std::string& label_source);
  void forget_locked(const ros::Time& stamp);
  void new_map_id();

  std::string frame_id_;
  MeshOutput config_;
  LabelSet labels_;
  mutable std::recursive_mutex mutex_;  // a subscriber's callback may run inside advertise()
  std::function<void(const std::string&)> on_problem_;
  MeshStatePtr state_;  // its mesh is empty once the chunks hold it
  ChunkedMesh chunks_;
  ChunkArchive archive_;
  bool in_chunks_ = false;     // a part is frozen: chunks_ and archive_ hold the mesh, not state_
  bool chunks_stale_ = false;  // chunks_ is older than state_
  std::string map_id_;
  std::uint32_t sequence_ = 0;
  std::uint32_t palette_version_ = 0;
  ros::Time stamp_;
  std::set<Label> shown_;
  ros::Publisher mesh_pub_;
  ros::Publisher marker_pub_;
  ros::Publisher points_pub_;
  ros::Publisher palette_pub_;
};

}  // namespace facet_mapping
