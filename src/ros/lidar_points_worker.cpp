// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/lidar_points_worker.h"

#include <utility>

namespace facet_mapping {

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

/// `dense`: all points in range, which hide more than those that are left.
PointFrame LidarPointsWorker::clean(const CompensatedScan& scan,
                                    std::vector<LabeledPoint>* dense,
                                    CloudReport* report) const {
  CloudConfig range_only = config_.cloud;
  range_only.voxel_m = 0.0;
  range_only.outlier_radius_m = 0.0;
  *dense = thin_cloud(scan.points, range_only);
  CloudReport counts;
  PointFrame frame{scan.stamp, scan.world_from_sensor, {}};
  frame.points = thin_cloud(scan.points, config_.cloud, &counts);
  report->not_finite += counts.not_finite;
  report->out_of_range += counts.out_of_range;
  report->isolated += counts.isolated;
  report->thinned += counts.thinned;
  report->points += counts.points;
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
