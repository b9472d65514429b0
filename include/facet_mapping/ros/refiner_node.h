// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// refiner: keyframes and the mapper's mesh -> the refined, relabelled mesh.
#pragma once

#include <mutex>

#include <facet_mapping/Reset.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "facet_mapping/ros/keyframe_store.h"
#include "facet_mapping/ros/label_image_publisher.h"
#include "facet_mapping/ros/map_mesh_input.h"
#include "facet_mapping/ros/mesh_publisher.h"
#include "facet_mapping/ros/mesh_services.h"
#include "facet_mapping/ros/node_config.h"
#include "facet_mapping/ros/node_diagnostics.h"
#include "facet_mapping/ros/posed_images.h"
#include "facet_mapping/ros/refine_services.h"
#include "facet_mapping/ros/refined_map.h"
#include "facet_mapping/ros/transform_queue.h"

namespace facet_mapping {

class RefinerNode {
 public:
  using Config = RefinerNodeConfig;

  /// Throws ConfigError.
  RefinerNode(ros::NodeHandle nh, ros::NodeHandle private_nh);
  ~RefinerNode();

  /// Ends the work; returns when the running iteration is done.
  void stop();

 private:
  bool wants(const Eigen::Isometry3d& map_from_camera);
  void on_image(LabeledView view, const std_msgs::Header& header);
  void on_time_jump(double jump_s);
  void on_result();
  void forget_everything();
  bool reset(Reset::Request& request, Reset::Response& response);
  void refresh_diagnostics();

  Config config_;
  LabelSet labels_;
  NodeDiagnostics diagnostics_;
  tf2_ros::Buffer tf_buffer_{ros::Duration(kTfCacheS)};
  tf2_ros::TransformListener tf_listener_;
  TransformQueue transforms_;
  KeyframeStore keyframes_;
  MeshPublisher refined_;
  MeshServices mesh_services_;
  RefinedMap meshes_;  // before the map's input, which tells it of updates
  MapMeshInput map_mesh_;
  LabelImagePublisher label_image_;
  std::mutex header_mutex_;
  std_msgs::Header newest_header_;  // of the newest keyframe's image
  PosedImages input_;
  ros::ServiceServer reset_server_;
  RefineServices services_;  // last: it uses all the others
};

}  // namespace facet_mapping
