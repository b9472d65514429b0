// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The refiner's mesh: the mapper's newest mesh with what was refined laid over it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>

#include "facet_mapping/mapping/refined_overlay.h"
#include "facet_mapping/mapping/vertex_ids.h"
#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/mesh_publisher.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

/// What a refinement starts from.
struct RefineStart {
  MeshStatePtr mesh;  ///< null: there is none
  MeshStatePtr map;   ///< the mapper's mesh on which it or its start_points lie; null: unrelated
};

/// Thread-safe. A mesh is published after each result and, once something was refined, after each
/// update of the map, though never for more than a quarter of the time.
class RefinedMap {
 public:
  /// `map`: the mapper's newest mesh, or null. The arguments must outlive this. `on_publish` is
  /// called after each new mesh.
  RefinedMap(std::function<MeshStatePtr()> map,
             MeshPublisher* refined,
             NodeDiagnostics* diagnostics,
             std::function<void()> on_publish);
  ~RefinedMap() { stop(); }
  RefinedMap(const RefinedMap&) = delete;
  RefinedMap& operator=(const RefinedMap&) = delete;

  RefineStart from_map() const;
  RefineStart from_refined() const;
  /// The mesh that shows most: the refined one, or the mapper's if nothing was refined since.
  MeshStatePtr newest() const;

  /// Takes a result that was made from `start` by a change of `part`, and publishes.
  void take(const RefineStart& start, TriangleMesh result, const MeshPart& part);
  /// Call it after each update of the mapper's mesh. Returns at once.
  void on_map_update();

  void clear(const ros::Time& stamp);
  void stop();

 private:
  /// Waits until it is time for the next merge; false if the end comes first.
  bool rest();
  void merge_again();
  void publish_locked(TriangleMesh mesh, const ros::Time& stamp);
  void publish_merged_locked();

  std::function<MeshStatePtr()> map_;
  MeshPublisher* refined_;
  NodeDiagnostics* diagnostics_;
  std::function<void()> on_publish_;
  mutable std::mutex mutex_;
  RefinedOverlay overlay_;
  VertexIds ids_;
  MeshStatePtr base_;  ///< the mapper's mesh of the present refined one; null: none or unrelated
  std::mutex rest_mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::chrono::steady_clock::time_point next_merge_;
  JobQueue jobs_;  // last: its thread uses all the others
};

}  // namespace facet_mapping
