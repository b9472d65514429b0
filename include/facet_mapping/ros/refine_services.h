// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ~refine, ~cancel_refine, ~relabel and ~progress of the refiner.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <facet_mapping/CancelRefine.h>
#include <facet_mapping/Refine.h>
#include <facet_mapping/Relabel.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2_ros/buffer.h>

#include "facet_mapping/ros/keyframe_store.h"
#include "facet_mapping/ros/long_job.h"
#include "facet_mapping/ros/mesh_publisher.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/refined_map.h"

namespace facet_mapping {

class RefineServices {
 public:
  struct Sources {
    RefinedMap* meshes = nullptr;  ///< the mapper's and the refined one
    std::string map_mesh_topic;
    std::string image_topic;
    const tf2_ros::Buffer* tf = nullptr;  ///< for the frame of a request's region
    const KeyframeStore* keyframes = nullptr;
    MeshPublisher* refined = nullptr;
    NodeDiagnostics* diagnostics = nullptr;
  };

  /// The services run in threads of their own, so that mapping goes on meanwhile.
  RefineServices(ros::NodeHandle private_nh, const RefinementConfig& defaults, Sources sources);
  ~RefineServices();

  void stop();

 private:
  struct Task;

  bool refine(Refine::Request& request, Refine::Response& response);
  bool relabel(Relabel::Request& request, Relabel::Response& response);
  bool cancel(CancelRefine::Request& request, CancelRefine::Response& response);

  Task prepare(const Refine::Request& request) const;
  RefineStart start_mesh(const Refine::Request& request) const;
  MeshStatePtr mesh_of_request(const LabeledMesh& message) const;
  std::vector<LabeledView> require_views(std::size_t least, const std::string& problem) const;
  /// Answers a dry run.
  std::string estimate(const std::shared_ptr<Task>& task, Refine::Response* response);
  RefinementResult run(const Task& task, std::string* why_stopped);
  bool report_progress(const Task& task,
                       const RefinementProgress& progress,
                       std::string* why_stopped);

  RefinementConfig defaults_;
  Sources sources_;
  LongJob job_;
  ros::Publisher progress_pub_;
  ros::CallbackQueue queue_;
  ros::ServiceServer cancel_server_;
  ros::ServiceServer relabel_server_;
  ros::ServiceServer refine_server_;
  ros::AsyncSpinner spinner_;
};

}  // namespace facet_mapping
