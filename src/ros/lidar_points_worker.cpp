// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/lidar_points_worker.h"

#include <utility>

namespace facet_mapping {
namespace {

std::vector<Eigen::Vector3f> positions_of(const std::vector<LabeledPoint>& points) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(points.size());
  for (const LabeledPoint& point : points) {
    positions.push_back(point.position);
  }
  return positions;
}

void add_to(const CloudReport& more, CloudReport* sum) {
  sum->not_finite += more.not_finite;
  sum->out_of_range += more.out_of_range;
  sum->isolated += more.isolated;
  sum->thinned += more.thinned;
}

}  // namespace

std::vector<PointFrame> LidarPointsWorker::work(const LidarJob& job, LidarJobReport* report) {
  const SensorPath path(job.map_from_sensor, config_.max_extrapolation_s);
  std::vector<PointFrame> frames;
  for (const CompensatedScan& part :
       compensate_motion(job.scan, path, config_.split_m, &report->motion)) {
    std::vector<LabeledPoint> dense;
    PointFrame frame = clean(part, &dense, &report->cloud);
    if (!job.labels.empty()) {
      report->labelled += label(job, dense, &frame);
    }
    remember(std::move(dense), part.world_from_sensor);
    if (!frame.points.empty()) {
      frames.push_back(std::move(frame));
    }
  }
  return frames;
}

/// `dense`: the clean points before they are thinned, which hide more than those that are left.
PointFrame LidarPointsWorker::clean(const CompensatedScan& scan,
                                    std::vector<LabeledPoint>* dense,
                                    CloudReport* report) const {
  CloudConfig without_thinning = config_.cloud;
  without_thinning.voxel_m = 0.0;
  CloudReport counts;
  *dense = thin_cloud(scan.points, without_thinning, &counts);
  add_to(counts, report);
  CloudConfig thinning_only = config_.cloud;
  thinning_only.outlier_radius_m = 0.0;
  PointFrame frame{scan.stamp, scan.world_from_sensor, {}};
  frame.points = thin_cloud(positions_of(*dense), thinning_only, &counts);
  add_to(counts, report);
  report->points += frame.points.size();
  return frame;
}

std::size_t LidarPointsWorker::label(const LidarJob& job,
                                     const std::vector<LabeledPoint>& dense,
                                     PointFrame* frame) {
  const Eigen::Isometry3d cam_from_map = job.camera.cam_from_world();
  std::vector<Occluders> occluders{{&dense, cam_from_map * frame->world_from_sensor}};
  for (const Earlier& scan : earlier_) {
    occluders.push_back({&scan.points, cam_from_map * scan.map_from_sensor});
  }
  return label_points_from_image(frame->points,
                                 cam_from_map * frame->world_from_sensor,
                                 job.camera.camera,
                                 job.labels,
                                 config_.labels,
                                 occluders);
}

void LidarPointsWorker::remember(std::vector<LabeledPoint> dense,
                                 const Eigen::Isometry3d& map_from_sensor) {
  earlier_.push_back({std::move(dense), map_from_sensor});
  while (earlier_.size() >= static_cast<std::size_t>(config_.occluder_scans)) {
    earlier_.pop_front();
  }
}

}  // namespace facet_mapping
