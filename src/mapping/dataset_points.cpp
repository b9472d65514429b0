// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/dataset_points.h"

#include <stdexcept>
#include <utility>

#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/points/without_sky.h"

namespace facet_mapping {
namespace {

constexpr char kTracks[] = "tracks";
constexpr char kSweep[] = "sweep";

void append(std::vector<PointFrame> frames, const char* sensor, std::vector<SensorPoints>* points) {
  for (PointFrame& frame : frames) {
    points->push_back({sensor, std::move(frame)});
  }
}

/// All points of a scan, so that those which thinning drops still hide what is behind them.
std::vector<LabeledPoint> labeled_points(const std::vector<Eigen::Vector3f>& scan) {
  std::vector<LabeledPoint> points;
  for (const Eigen::Vector3f& position : scan) {
    points.push_back({position, kUnlabelled, 0.0F});
  }
  return points;
}

}  // namespace

cv::Mat frame_label_image(const DatasetFrame& frame, const LabelSet& labels) {
  if (frame.labels.empty() || labels.empty()) {
    return {};
  }
  const cv::Mat ids = read_labels(frame.labels);
  return resize_label_image(decode_label_image(ids, "mono16", labels),
                            {frame.view.camera.width, frame.view.camera.height});
}

DatasetPoints::DatasetPoints(const Dataset& dataset,
                             const LabelSet& labels,
                             const DatasetPointsConfig& config)
    : dataset_(dataset),
      labels_(labels),
      config_(config),
      tracker_(without_sky(config.track_config, labels)),
      sweeper_(without_sky(config.sweep_config, labels)) {
  if (!config.stereo && !config.lidar && !config.tracks && !config.sweep) {
    throw std::invalid_argument(
        "no source of points: choose stereo, lidar, tracks, sweep or several");
  }
  if (config.stereo && !dataset.has_right) {
    throw std::invalid_argument(
        "the dataset has no right images, so there are no stereo points: use its LiDAR scans, "
        "feature tracks, plane sweeping or the points of a mesh");
  }
  if (config.lidar && !dataset.has_scans) {
    throw std::invalid_argument(
        "the dataset has no LiDAR scans: use stereo points, feature tracks, plane sweeping or "
        "the points of a mesh");
  }
  config_.stereo_config.excluded_labels = labels.sky_ids();
}

std::vector<SensorPoints> DatasetPoints::read(std::size_t index) const {
  const DatasetFrame& frame = dataset_.frames.at(index);
  const cv::Mat labels = frame_label_image(frame, labels_);
  std::vector<SensorPoints> points;
  if (config_.stereo && !frame.right_image.empty()) {
    points.push_back(read_stereo(frame, labels));
  }
  if (config_.lidar && !frame.scan.empty()) {
    points.push_back(read_lidar(frame, labels));
  }
  return points;
}

std::vector<SensorPoints> DatasetPoints::follow(std::size_t index,
                                                TrackReport* tracks,
                                                SweepReport* sweep) {
  const DatasetFrame& frame = dataset_.frames.at(index);
  std::vector<SensorPoints> points;
  if (!config_.tracks && !config_.sweep) {
    return points;
  }
  const cv::Mat labels = frame_label_image(frame, labels_);
  const cv::Mat gray = read_gray(frame.left_image);
  if (config_.tracks) {
    append(tracker_.add(gray, frame.view, labels, frame.stamp, tracks), kTracks, &points);
  }
  if (config_.sweep) {
    append(sweeper_.add(gray, frame.view, labels, frame.stamp, sweep), kSweep, &points);
  }
  std::vector<LabeledPoint> sky =
      sky_points(labels, frame.view.camera, labels_.sky_ids(), config_.sky_config);
  if (!sky.empty()) {
    points.push_back({config_.tracks ? kTracks : kSweep,
                      {frame.stamp, frame.view.world_from_cam, std::move(sky)}});
  }
  return points;
}

std::vector<SensorPoints> DatasetPoints::finish() {
  std::vector<SensorPoints> points;
  append(tracker_.finish(), kTracks, &points);
  append(sweeper_.finish(), kSweep, &points);
  return points;
}

SensorPoints DatasetPoints::read_stereo(const DatasetFrame& frame, const cv::Mat& labels) const {
  SensorPoints result{"stereo", {frame.stamp, frame.view.world_from_cam, {}}};
  result.frame.points = stereo_points(read_gray(frame.left_image),
                                      read_gray(frame.right_image),
                                      labels,
                                      frame.view.camera,
                                      dataset_.baseline_m(),
                                      config_.stereo_config);
  const std::vector<LabeledPoint> sky =
      sky_points(labels, frame.view.camera, labels_.sky_ids(), config_.sky_config);
  result.frame.points.insert(result.frame.points.end(), sky.begin(), sky.end());
  return result;
}

SensorPoints DatasetPoints::read_lidar(const DatasetFrame& frame, const cv::Mat& labels) const {
  std::vector<Eigen::Vector3f> scan;
  for (const Eigen::Vector4f& hit : read_scan(frame.scan)) {
    scan.emplace_back(hit.head<3>());
  }
  SensorPoints result{"lidar",
                      {frame.stamp, frame.view.world_from_cam * dataset_.left_from_velo, {}}};
  result.frame.points = thin_cloud(scan, config_.cloud_config);
  if (!labels.empty()) {
    ImageLabelConfig config;
    config.excluded_labels = labels_.sky_ids();
    const std::vector<LabeledPoint> whole_scan = labeled_points(scan);
    label_points_from_image(result.frame.points,
                            dataset_.left_from_velo,
                            frame.view.camera,
                            labels,
                            config,
                            {{&whole_scan, dataset_.left_from_velo}});
  }
  return result;
}

}  // namespace facet_mapping
