// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/refiner_node.h"

#include <string>
#include <utility>

#include "facet_mapping/ros/node_setup.h"
#include "facet_mapping/ros/service_status.h"

namespace facet_mapping {
namespace {

KeyframeLimits limits_of(const RefinerNodeConfig& config) {
  KeyframeLimits limits;
  limits.translation_m = config.keyframe_translation_m;
  limits.rotation_deg = config.keyframe_rotation_deg;
  limits.max_count = static_cast<std::size_t>(config.max_keyframes);
  limits.max_bytes = static_cast<std::size_t>(config.max_keyframe_mib) << 20;
  return limits;
}

}  // namespace

RefinerNode::RefinerNode(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : labels_(set_up_node(parameter_table(&config_), private_nh, &config_.segmentation.label_file)),
      diagnostics_(nh, private_nh),
      tf_listener_(tf_buffer_, nh),
      transforms_(nh, &tf_buffer_, config_.pose, &diagnostics_),
      keyframes_(limits_of(config_)),
      refined_(private_nh,
               config_.pose.map_frame,
               config_.output,
               labels_,
               config_.segmentation.label_file),
      mesh_services_(private_nh, &refined_, &tf_buffer_, "call ~refine (or ~relabel) first"),
      meshes_(
          [this] { return map_mesh_.mesh(); }, &refined_, &diagnostics_, [this] { on_result(); }),
      map_mesh_(nh, config_.pose.map_frame, &diagnostics_, [this] { meshes_.on_map_update(); }),
      label_image_(
          private_nh, labels_, [this] { return meshes_.newest(); }, &keyframes_, &diagnostics_),
      input_(nh,
             config_.segmentation,
             labels_,
             &transforms_,
             &diagnostics_,
             {[this](const Eigen::Isometry3d& pose) { return wants(pose); },
              [this](LabeledView view, const std_msgs::Header& header) {
                on_image(std::move(view), header);
              },
              [this](double jump_s) { on_time_jump(jump_s); }}),
      reset_server_(private_nh.advertiseService("reset", &RefinerNode::reset, this)),
      services_(private_nh,
                config_.refinement,
                {&meshes_,
                 map_mesh_.topic(),
                 nh.resolveName("image_rect"),
                 &tf_buffer_,
                 &keyframes_,
                 &refined_,
                 &diagnostics_}) {
  diagnostics_.on_publish([this] { refresh_diagnostics(); });
}

RefinerNode::~RefinerNode() {
  stop();
}

void RefinerNode::stop() {
  services_.stop();
  meshes_.stop();
  label_image_.stop();
  map_mesh_.stop();
}

bool RefinerNode::wants(const Eigen::Isometry3d& map_from_camera) {
  const bool wanted = keyframes_.wants(map_from_camera);
  if (!wanted) {
    diagnostics_.count("images too near the last keyframe");
  }
  return wanted;
}

void RefinerNode::on_image(LabeledView view, const std_msgs::Header& header) {
  const std::size_t dropped = keyframes_.add(std::move(view));
  diagnostics_.count("keyframes");
  if (dropped > 0) {
    diagnostics_.count("old keyframes dropped", dropped);
  }
  {
    const std::lock_guard<std::mutex> lock(header_mutex_);
    newest_header_ = header;
  }
  label_image_.update(header);
}

void RefinerNode::on_result() {
  std_msgs::Header header;
  {
    const std::lock_guard<std::mutex> lock(header_mutex_);
    header = newest_header_;
  }
  label_image_.update(header);
}

void RefinerNode::on_time_jump(double jump_s) {
  const bool resets = config_.pose.on_time_jump == TimeJumpPolicy::kReset;
  diagnostics_.complain("time jumped back",
                        "image stamps jumped back by " + std::to_string(jump_s) +
                            " s (a bag in a loop?): " +
                            (resets ? "the keyframes are forgotten; set on_time_jump to ignore to "
                                      "keep them"
                                    : "the keyframes are kept, since on_time_jump is ignore"));
  transforms_.clear();
  tf_buffer_.clear();  // static transforms survive this
  if (resets) {
    keyframes_.clear();
  }
}

void RefinerNode::forget_everything() {
  transforms_.clear();
  input_.clear();
  keyframes_.clear();
  meshes_.clear(ros::Time::now());
}

bool RefinerNode::reset(Reset::Request& /*request*/, Reset::Response& response) {
  response.status = answer([this] {
    forget_everything();
    return std::string("keyframes and refined mesh are forgotten; the mapper's mesh is kept");
  });
  return true;
}

void RefinerNode::refresh_diagnostics() {
  input_.refresh_diagnostics();
  diagnostics_.set("frames waiting for their transform", static_cast<double>(transforms_.size()));
  diagnostics_.set("keyframes kept", static_cast<double>(keyframes_.size()));
  diagnostics_.set("keyframes kept with segmentation", static_cast<double>(keyframes_.labelled()));
  diagnostics_.set("keyframe memory [MiB]",
                   static_cast<double>(keyframes_.bytes()) / (1024.0 * 1024.0));
}

}  // namespace facet_mapping
