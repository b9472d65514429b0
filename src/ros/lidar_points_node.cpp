// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/lidar_points_node.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <boost/make_shared.hpp>
#include <tf2_eigen/tf2_eigen.h>

#include "facet_mapping/ros/cloud_conversions.h"
#include "facet_mapping/ros/image_conversions.h"
#include "facet_mapping/ros/node_setup.h"

namespace facet_mapping {
namespace {

constexpr std::uint32_t kQueueSize = 100;  // of each topic; drivers may send packets
constexpr double kPollPeriodS = 0.1;
constexpr double kIdleS = 0.5;            // without a further cloud a frame is complete
constexpr double kTfCacheMarginS = 10.0;  // beyond the time that scans may wait

NearestLabels::Config nearest_config(const LidarPointsNodeConfig& config) {
  return {config.segmentation_tolerance_s,
          config.segmentation.timeout_s,
          config.segmentation.cache_s,
          static_cast<std::size_t>(config.queue_size)};
}

}  // namespace

struct LidarPointsNode::Frame {
  std_msgs::Header header;
  LidarJob job;
  double first = 0.0;  // seconds, as all poses are needed from here ...
  double last = 0.0;   // ... to here
  NearestLabels::Image image;
  std::string camera_frame;
};

LidarPointsNode::LidarPointsNode(ros::NodeHandle nh, ros::NodeHandle private_nh)
    : labels_(set_up_node(parameter_table(&config_), private_nh, &config_.segmentation.label_file)),
      diagnostics_(nh, private_nh),
      tf_buffer_(ros::Duration(kTfCacheMarginS + config_.segmentation.timeout_s +
                               config_.pose.tf_timeout_s)),
      tf_listener_(tf_buffer_, nh),
      transforms_(nh, &tf_buffer_, config_.pose, &diagnostics_),
      segmentation_(config_.segmentation, labels_, &diagnostics_),
      nearest_(nearest_config(config_)),
      accumulator_(config_.frame_s),
      cloud_topic_(nh.resolveName("point_cloud")),
      info_topic_(nh.resolveName("camera_info")),
      worker_([this] {
        config_.labels.excluded_labels = labels_.sky_ids();
        return config_;
      }()),
      jobs_(static_cast<std::size_t>(config_.queue_size),
            [this](const std::string& error) { diagnostics_.complain("scan failed", error); }) {
  points_pub_ = nh.advertise<sensor_msgs::PointCloud2>("points", kQueueSize);
  diagnostics_.on_publish([this] { refresh_diagnostics(); });
  subscribe(nh);
  poll_timer_ = nh.createWallTimer(ros::WallDuration(kPollPeriodS), [this](const auto&) {
    if ((ros::WallTime::now() - gathered_at_).toSec() > kIdleS) {
      finish_frame();
    }
    nearest_.poll(ros::WallTime::now());
  });
}

LidarPointsNode::~LidarPointsNode() {
  stop();
}

void LidarPointsNode::stop() {
  jobs_.stop();
}

void LidarPointsNode::subscribe(ros::NodeHandle nh) {
  diagnostics_.expect_input(cloud_topic_);
  cloud_subscriber_ = nh.subscribe<sensor_msgs::PointCloud2>(
      "point_cloud", kQueueSize, [this](const sensor_msgs::PointCloud2ConstPtr& cloud) {
        receive(cloud);
      });
  if (!config_.segmentation.use_segmentation) {
    return;
  }
  diagnostics_.expect_input(info_topic_);
  info_subscriber_ = nh.subscribe<sensor_msgs::CameraInfo>(
      "camera_info", kQueueSize, [this](const sensor_msgs::CameraInfoConstPtr& info) {
        diagnostics_.count_input(info_topic_);
        info_ = info;
      });
  segmentation_.subscribe(nh, [this](const ros::Time& stamp, boost::shared_ptr<const void> m) {
    if (stamp.isZero()) {
      diagnostics_.complain("no stamp",
                            "a label image has no stamp in its header: it must carry its image's");
      return;
    }
    check_time("segmentation", stamp);
    nearest_.add_image(stamp, std::move(m), ros::WallTime::now());
  });
}

void LidarPointsNode::check_time(const std::string& source, const ros::Time& stamp) {
  if (!time_jump_.jumped_back(source, stamp)) {
    return;
  }
  const bool resets = config_.pose.on_time_jump == TimeJumpPolicy::kReset;
  diagnostics_.complain("time jumped back",
                        "stamps of " + source + " jumped back by " +
                            std::to_string(time_jump_.jump_s()) + " s (a bag in a loop?)" +
                            (resets ? ": scans that wait and earlier scans are forgotten"
                                    : "; nothing is forgotten, since on_time_jump is ignore"));
  accumulator_.clear();
  if (resets) {
    nearest_.clear();
    transforms_.clear();
    tf_buffer_.clear();  // static transforms survive this
    jobs_.post([this] { worker_.clear(); });
  }
}

bool LidarPointsNode::is_wanted(const std_msgs::Header& header) {
  if (header.stamp.isZero() || header.frame_id.empty()) {
    diagnostics_.complain(header.stamp.isZero() ? "no stamp" : "no frame_id",
                          "'" + cloud_topic_ +
                              "': a cloud's header has no stamp or no frame_id, without which its "
                              "pose cannot be looked up; set them in the driver");
    return false;
  }
  check_time("clouds", header.stamp);
  diagnostics_.count("clouds");
  if (points_pub_.getNumSubscribers() == 0) {
    diagnostics_.count("clouds skipped without subscriber");
    accumulator_.clear();
    return false;
  }
  return true;
}

void LidarPointsNode::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  diagnostics_.count_input(cloud_topic_);
  if (!is_wanted(cloud->header)) {
    return;
  }
  try {
    CloudTimes times;
    LidarScan scan = scan_from_cloud(*cloud, config_.time, &times);
    note_times(times);
    if (scan.points.empty()) {
      diagnostics_.complain("empty cloud",
                            "'" + cloud_topic_ + "': a cloud without a single return was ignored");
      return;
    }
    gather(std::move(scan), cloud->header);
  } catch (const std::invalid_argument& e) {
    diagnostics_.complain("unusable cloud",
                          "'" + cloud_topic_ + "': " + e.what() + "; the cloud is dropped");
  }
}

void LidarPointsNode::note_times(const CloudTimes& times) {
  diagnostics_.count("points without return", times.no_return);
  diagnostics_.set("field of the point times", times.field.empty() ? "none" : times.field);
  if (times.field.empty()) {
    return;
  }
  diagnostics_.set("unit of the point times", name_of(times.times.unit));
  if (times.times.constant) {
    diagnostics_.complain("point times all alike",
                          "'" + cloud_topic_ + "': all points of a cloud have the same time in '" +
                              times.field +
                              "', so that its motion cannot be compensated; set time_field to none "
                              "if the scans are compensated already");
  }
}

void LidarPointsNode::gather(LidarScan scan, const std_msgs::Header& header) {
  if (!gathered_.frame_id.empty() && gathered_.frame_id != header.frame_id) {
    finish_frame();  // of another sensor
  }
  std_msgs::Header complete = gathered_;
  gathered_ = header;
  gathered_at_ = ros::WallTime::now();
  std::optional<LidarScan> frame = accumulator_.add(std::move(scan));
  if (!frame) {
    return;
  }
  if (config_.frame_s == 0.0) {
    complete = header;
  } else {
    complete.stamp = ros::Time(frame->stamp);
  }
  accept(std::move(*frame), complete);
}

void LidarPointsNode::finish_frame() {
  std::optional<LidarScan> frame = accumulator_.finish();
  if (frame) {
    gathered_.stamp = ros::Time(frame->stamp);
    accept(std::move(*frame), gathered_);
  }
}

void LidarPointsNode::accept(LidarScan scan, const std_msgs::Header& header) {
  auto frame = boost::make_shared<Frame>();
  frame->header = header;
  frame->header.frame_id = without_slash(header.frame_id);
  frame->first = frame->last = scan.stamp;
  for (const double offset_s : scan.offsets_s) {
    if (std::isfinite(offset_s)) {
      frame->first = std::min(frame->first, scan.stamp + offset_s);
      frame->last = std::max(frame->last, scan.stamp + offset_s);
    }
  }
  frame->job.scan = std::move(scan);
  if (!config_.segmentation.use_segmentation) {
    find_sensor(frame);
    return;
  }
  if (!nearest_.add_scan(header.stamp, ros::WallTime::now(), [this, frame](const auto& image) {
        set_labels(frame, image);
      })) {
    diagnostics_.complain("too many scans wait",
                          std::to_string(config_.queue_size) +
                              " scans wait for their label image already, one is dropped: gather "
                              "packets by frame_s, or raise queue_size");
  }
}

std::string LidarPointsNode::unusable_labels(const NearestLabels::Image& image) const {
  if (image.message == nullptr) {
    return "no label image within " + std::to_string(config_.segmentation_tolerance_s) +
           " s of the scan's stamp came within " + std::to_string(config_.segmentation.timeout_s) +
           " s; raise segmentation_tolerance_s for a slow camera or segmentation_timeout_s for a "
           "slow network, or set use_segmentation to false";
  }
  if (info_ == nullptr) {
    return "no message on '" + info_topic_ + "' yet";
  }
  return "";
}

void LidarPointsNode::set_labels(const FramePtr& frame, const NearestLabels::Image& image) {
  const std::string problem = unusable_labels(image);
  if (!problem.empty()) {
    diagnostics_.complain(image.message == nullptr ? "no segmentation" : "no camera_info",
                          "scan at " + std::to_string(frame->header.stamp.toSec()) + ": " +
                              problem + ": its points stay unlabelled");
    find_sensor(frame);
    return;
  }
  try {
    const cv::Size size(static_cast<int>(info_->width), static_cast<int>(info_->height));
    frame->job.camera.camera = camera_from_info(*info_, size, info_topic_);
    frame->camera_frame = info_->header.frame_id;
    frame->image = image;
  } catch (const std::invalid_argument& e) {
    diagnostics_.complain("unusable camera_info",
                          std::string(e.what()) + "; the scan's points stay unlabelled");
  }
  find_sensor(frame);
}

void LidarPointsNode::find_sensor(const FramePtr& frame) {
  // With segmentation the scan may have to hide points of the next ones: the map must know where.
  const bool needs_no_pose =
      frame->job.scan.offsets_s.empty() && !config_.segmentation.use_segmentation;
  if (needs_no_pose) {
    frame->job.map_from_sensor = {{frame->job.scan.stamp, Eigen::Isometry3d::Identity()}};
    post(frame);
    return;
  }
  const double needed = std::max(frame->job.scan.stamp, frame->last - config_.max_extrapolation_s);
  const bool is_instant = needed == frame->job.scan.stamp;
  transforms_.push(frame->header.frame_id,
                   is_instant ? frame->header.stamp : ros::Time(needed),
                   [this, frame](const Eigen::Isometry3d& map_from_sensor) {
                     if (frame->job.scan.offsets_s.empty()) {
                       frame->job.map_from_sensor = {{frame->job.scan.stamp, map_from_sensor}};
                     } else {
                       sample_path(frame);
                     }
                     find_camera(frame);
                   });
}

/// What tf does not know is left out: the compensation says then which poses it needs.
void LidarPointsNode::sample_path(const FramePtr& frame) const {
  const double seconds = frame->last - frame->first;
  const int steps = std::max(1, static_cast<int>(std::ceil(seconds / config_.pose_step_s)));
  for (int i = 0; i <= steps; ++i) {
    // A scan of one instant, too, may have to be carried to its stamp.
    const double stamp = frame->first + i * std::max(seconds / steps, 1e-6);
    try {
      const Eigen::Isometry3d pose = tf2::transformToEigen(tf_buffer_.lookupTransform(
          without_slash(config_.pose.map_frame), frame->header.frame_id, ros::Time(stamp)));
      if (is_rigid(pose)) {
        frame->job.map_from_sensor.push_back({stamp, pose});
      }
    } catch (const tf2::TransformException&) {
      continue;
    }
  }
}

void LidarPointsNode::find_camera(const FramePtr& frame) {
  if (frame->image.message == nullptr) {
    post(frame);
    return;
  }
  transforms_.push(frame->camera_frame,
                   frame->image.stamp,
                   [this, frame](const Eigen::Isometry3d& map_from_camera) {
                     frame->job.camera.world_from_cam = map_from_camera;
                     post(frame);
                   });
}

void LidarPointsNode::post(const FramePtr& frame) {
  if (!jobs_.post([this, frame] { work(frame); })) {
    diagnostics_.complain("scans too fast",
                          std::to_string(config_.queue_size) +
                              " scans wait for the work already, one is dropped: lower the rate "
                              "or max_range_m, set outlier_radius_m to 0, or raise queue_size");
  }
}

void LidarPointsNode::work(const FramePtr& frame) {
  const ros::WallTime start = ros::WallTime::now();
  const PinholeCamera& camera = frame->job.camera.camera;
  frame->job.labels =
      segmentation_.read(frame->image.message, cv::Size(camera.width, camera.height));
  LidarJobReport report;
  try {
    const std::vector<PointFrame> parts = worker_.work(frame->job, &report);
    for (const PointFrame& part : parts) {
      publish(part, frame->header);
    }
    if (parts.empty()) {
      diagnostics_.complain("no usable point",
                            "not one point of a scan is between min_range_m and max_range_m and "
                            "near others; are the points metres in their sensor's frame?");
    }
  } catch (const std::invalid_argument& e) {
    diagnostics_.complain("unusable poses", std::string(e.what()) + "; the scan is dropped");
  }
  note(report);
  diagnostics_.set("seconds of the last scan", (ros::WallTime::now() - start).toSec());
}

void LidarPointsNode::publish(const PointFrame& points, const std_msgs::Header& header) {
  std_msgs::Header own = header;
  if (points.stamp != header.stamp.toSec()) {  // else the exact stamp is kept
    own.stamp = ros::Time(points.stamp);
  }
  points_pub_.publish(cloud_from_points(points.points, own));
  diagnostics_.count("clouds published");
  diagnostics_.count("points published", points.points.size());
}

void LidarPointsNode::note(const LidarJobReport& report) {
  diagnostics_.count("points labelled", report.labelled);
  diagnostics_.count("points out of range", report.cloud.out_of_range);
  diagnostics_.count("points isolated", report.cloud.isolated);
  diagnostics_.count("points thinned", report.cloud.thinned);
  diagnostics_.count("points without time", report.motion.without_time);
  diagnostics_.set("duration of the last scan, s", report.motion.seconds);
  diagnostics_.set("way during the last scan, m", report.motion.moved_m);
}

void LidarPointsNode::refresh_diagnostics() {
  diagnostics_.set("scans waiting for their label image", static_cast<double>(nearest_.waiting()));
  diagnostics_.set("scans waiting for a transform", static_cast<double>(transforms_.size()));
  diagnostics_.set("scans waiting for the work", static_cast<double>(jobs_.size()));
}

}  // namespace facet_mapping
