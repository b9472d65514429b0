// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mapper's mesh in another node: topic `mesh`, and service `get_mesh` when something was
// missed.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include <facet_mapping/LabeledMesh.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "facet_mapping/ros/job_queue.h"
#include "facet_mapping/ros/mesh_publisher.h"
#include "facet_mapping/ros/mesh_receiver.h"
#include "facet_mapping/ros/node_diagnostics.h"

namespace facet_mapping {

class MapMeshInput {
 public:
  /// `on_update` is called after each update, in the thread that received it.
  MapMeshInput(ros::NodeHandle nh,
               const std::string& map_frame,
               NodeDiagnostics* diagnostics,
               std::function<void()> on_update);

  /// The newest mesh; null before the first. Welded on demand and kept. Thread-safe.
  MeshStatePtr mesh();
  /// Topic as resolved, for sentences.
  const std::string& topic() const { return topic_; }
  void stop() { jobs_.stop(); }

 private:
  void receive(const LabeledMeshConstPtr& message);
  MeshReceiver::Result apply(const LabeledMesh& message);
  void request_full();
  void request_first();

  std::string map_frame_;
  NodeDiagnostics* diagnostics_;
  std::function<void()> on_update_;
  std::string topic_;
  std::mutex mutex_;  // guards the receiver and the cache
  MeshReceiver receiver_;
  MeshStatePtr cache_;
  ros::ServiceClient client_;
  JobQueue jobs_;
  ros::Subscriber subscriber_;
  ros::WallTimer first_timer_;
};

}  // namespace facet_mapping
