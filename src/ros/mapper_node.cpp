// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mapper_node.h"

#include <algorithm>
#include <iomanip>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "facet_mapping/ros/cloud_conversions.h"
#include "facet_mapping/ros/file_paths.h"
#include "facet_mapping/ros/mesh_stats.h"
#include "facet_mapping/ros/node_setup.h"
#include "facet_mapping/ros/process_memory.h"
#include "facet_mapping/ros/service_status.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 100;  // of each topic
constexpr std::uint32_t kStatsQueueSize = 10;
constexpr double kStatsPeriodS = 1.0;

constexpr char kHowToGetAMesh[] =
    "points with a pose must come first; see the topics under point_topics (`rostopic hz`) and the "
    "mapper's entry on /diagnostics";

/// The map knows how far its points may be.
CloudConfig cloud_config(const MapperNodeConfig& config) {
  CloudConfig cloud = config.cloud;
  cloud.max_range_m = config.map.max_range_m;
  return cloud;
}

}  // namespace

MapperNode::MapperNode(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : labels_(set_up_node(parameter_table(&config_), private_nh, &config_.label_file)),
      diagnostics_(nh, private_nh),
      tf_listener_(tf_buffer_, nh),
      transforms_(nh, &tf_buffer_, config_.pose, &diagnostics_),
      publisher_(private_nh,
                 config_.pose.map_frame,
                 config_.output,
                 labels_,
                 config_.label_file,
                 folder_path(config_.archive_folder),
                 [this](const std::string& problem) {
                   diagnostics_.complain("archive of frozen chunks", problem);
                 }),
      services_(private_nh, &publisher_, &tf_buffer_, kHowToGetAMesh),
      keyframe_path_(private_nh, config_.pose.map_frame),
      worker_(
          labels_,
          config_.map,
          cloud_config(config_),
          static_cast<std::size_t>(config_.queue_size),
          config_.update_period_s,
          {[this](const FrameReport& report) { note_frame(report); },
           [this](const CloudReport& report) { note_cloud(report); },
           [this](MapUpdate update) { publish_update(std::move(update)); },
           [this](const std::string& error) { diagnostics_.complain("map update failed", error); },
           [this](const CorrectionReport& report) { corrected_poses_.report(report); }}),
      corrected_poses_(
          nh,
          config_.pose.map_frame,
          config_.corrected_frame,
          &tf_buffer_,
          &diagnostics_,
          [this](PoseCorrections poses) { return worker_.correct(std::move(poses)); }) {
  stats_pub_ = private_nh.advertise<MeshStats>("stats", kStatsQueueSize);
  stats_timer_ = nh.createWallTimer(ros::WallDuration(kStatsPeriodS),
                                    [this](const ros::WallTimerEvent&) { publish_stats(); });
  reset_server_ = private_nh.advertiseService("reset", &MapperNode::reset, this);
  diagnostics_.on_publish([this] {
    diagnostics_.set("frames waiting for their transform", static_cast<double>(transforms_.size()));
    diagnostics_.set("frames waiting for the map", static_cast<double>(worker_.size()));
  });
  for (const std::string& topic : config_.point_topics) {
    const std::string resolved = nh.resolveName(topic);
    diagnostics_.expect_input(resolved);
    subscribers_.push_back(nh.subscribe<sensor_msgs::PointCloud2>(
        topic, kQueueSize, [this, resolved](const sensor_msgs::PointCloud2ConstPtr& cloud) {
          receive(resolved, cloud);
        }));
  }
  bytes_at_start_ = process_memory().own();
}

MapperNode::~MapperNode() {
  stop();
}

void MapperNode::stop() {
  worker_.stop();
}

void MapperNode::receive(const std::string& topic, const sensor_msgs::PointCloud2ConstPtr& cloud) {
  diagnostics_.count_input(topic);
  check_time(topic, cloud->header.stamp);
  try {
    PointFrame frame;
    frame.stamp = cloud->header.stamp.toSec();
    frame.points = points_from_cloud(*cloud);
    if (frame.points.empty()) {
      diagnostics_.complain("empty cloud", "'" + topic + "': a cloud without points was ignored");
      return;
    }
    corrected_poses_.note_sensor(topic, cloud->header.frame_id);
    const bool is_scan = !has_label_field(*cloud);
    transforms_.push(cloud->header.frame_id,
                     cloud->header.stamp,
                     [this, topic, is_scan, frame = std::move(frame)](
                         const Eigen::Isometry3d& map_from_sensor) mutable {
                       frame.world_from_sensor = map_from_sensor;
                       enqueue(topic, is_scan, std::move(frame));
                     });
  } catch (const std::invalid_argument& e) {
    diagnostics_.complain("unusable cloud", "'" + topic + "': " + e.what());
  }
}

void MapperNode::check_time(const std::string& topic, const ros::Time& stamp) {
  if (!time_jump_.jumped_back(topic, stamp)) {
    return;
  }
  const bool resets = config_.pose.on_time_jump == TimeJumpPolicy::kReset;
  diagnostics_.complain("time jumped back",
                        "stamps on '" + topic + "' jumped back by " +
                            std::to_string(time_jump_.jump_s()) + " s (a bag in a loop?): " +
                            (resets ? "the map is forgotten; set on_time_jump to ignore to keep it"
                                    : "the map is kept, since on_time_jump is ignore"));
  transforms_.clear();
  tf_buffer_.clear();  // static transforms survive this
  if (resets) {
    forget_everything();
  }
}

void MapperNode::enqueue(const std::string& topic, bool is_scan, PointFrame frame) {
  if (!worker_.push(std::move(frame), topic, is_scan)) {
    diagnostics_.complain("map too slow",
                          std::to_string(config_.queue_size) +
                              " frames wait for the map already, one is dropped: raise "
                              "keyframe_translation_m, thin the points, or raise queue_size");
  }
}

void MapperNode::forget_everything() {
  worker_.reset([this] {
    publisher_.reset(ros::Time::now());
    keyframe_path_.publish(std::make_shared<const std::map<KeyframeId, Keyframe>>());
    const std::lock_guard<std::mutex> lock(update_mutex_);
    last_update_ = {};
  });
}

bool MapperNode::reset(Reset::Request& /*request*/, Reset::Response& response) {
  response.status = answer([this] {
    transforms_.clear();
    forget_everything();
    return std::string("the map is empty");
  });
  return true;
}

void MapperNode::note_frame(const FrameReport& report) {
  diagnostics_.count(report.keyframe ? "keyframes" : "frames too near the last keyframe");
  diagnostics_.count("points used", report.used);
  diagnostics_.count("points out of range", report.out_of_range);
  diagnostics_.count("points of dynamic classes dropped", report.dynamic_dropped);
  if (report.not_finite > 0) {
    diagnostics_.count("points not finite", report.not_finite);
  }
  if (report.keyframe && report.used == 0) {
    diagnostics_.complain("no usable point",
                          "not one point of a keyframe is finite and between min_range_m and "
                          "max_range_m; are the points metres in their sensor's frame?");
  }
  if (report.unknown_label > 0) {
    diagnostics_.count("points of unknown classes", report.unknown_label);
    diagnostics_.complain("unknown classes",
                          std::to_string(report.unknown_label) +
                              " points of a frame have class ids that '" + config_.label_file +
                              "' does not list; they carve, but add no class");
  }
}

void MapperNode::note_cloud(const CloudReport& report) {
  diagnostics_.count("scan points kept", report.points);
  diagnostics_.count("scan points not finite", report.not_finite);
  diagnostics_.count("scan points out of range", report.out_of_range);
  diagnostics_.count("scan points isolated", report.isolated);
  diagnostics_.count("scan points thinned", report.thinned);
}

void MapperNode::publish_update(MapUpdate update) {
  auto state = std::make_shared<MeshState>();
  state->mesh = std::move(update.surface.mesh);
  state->vertex_ids = std::move(update.surface.vertex_ids);
  state->stamp = ros::Time(std::max(0.0, update.stamp));
  state->line = update.line;
  publisher_.publish(std::move(state));
  keyframe_path_.publish(update.movable);
  note_update(update);
  update.surface = {};
  const std::lock_guard<std::mutex> lock(update_mutex_);
  last_update_ = std::move(update);
}

void MapperNode::note_update(const MapUpdate& update) {
  diagnostics_.count("updates");
  diagnostics_.set("seconds of the last update", update.seconds);
  diagnostics_.set("facets", static_cast<double>(publisher_.facets()));
  diagnostics_.set("frozen chunks", static_cast<double>(publisher_.frozen().chunks));
  if (update.range_scale < 1.0) {
    std::ostringstream text;
    text << std::setprecision(3) << "the map has reached memory_budget_mib ("
         << config_.map.memory_budget_mb << " MiB), so that its ranges shrink: points farther than "
         << update.range_scale * config_.map.max_range_m
         << " m are dropped; raise memory_budget_mib, thin the points or raise "
            "keyframe_translation_m";
    diagnostics_.complain("memory budget", text.str());
  }
}

void MapperNode::publish_stats() {
  if (stats_pub_.getNumSubscribers() == 0) {
    return;
  }
  MeshStats stats;
  fill_mesh_stats(publisher_.totals(), &stats);
  fill_stats(&stats);
  stats_pub_.publish(stats);
}

void MapperNode::fill_stats(MeshStats* stats) const {
  stats->header.stamp = publisher_.stamp();
  stats->header.frame_id = config_.pose.map_frame;
  stats->map_id = publisher_.map_id();
  stats->sequence = publisher_.sequence();
  stats->pending = static_cast<std::uint32_t>(worker_.size() + transforms_.size());
  const FrozenStats frozen = publisher_.frozen();
  stats->frozen_chunks = frozen.chunks;
  stats->frozen_facets = frozen.facets;
  const ProcessMemory memory = process_memory();
  stats->resident_bytes = memory.resident;
  stats->bytes = bytes_at_start_ + memory.shared + publisher_.bytes() + worker_.bytes();
  const std::lock_guard<std::mutex> lock(update_mutex_);
  stats->bytes += last_update_.map_bytes;
  stats->cells = last_update_.stats.cells;
  stats->rays = last_update_.stats.rays;
  stats->keyframes = static_cast<std::uint32_t>(last_update_.keyframes);
  stats->range_scale = last_update_.range_scale;
  stats->update_seconds = last_update_.seconds;
  if (last_update_.movable) {
    stats->movable_keyframes = static_cast<std::uint32_t>(last_update_.movable->size());
  }
}

}  // namespace facet_mapping
